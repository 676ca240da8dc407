#!/usr/bin/python3
"""Print `passed|failed|skipped NAME` for every test case that ctest ran in a build folder.

usage: test_cases.py BUILD

ctest.xml there tells which programs ran and how they ended, test_results/sightline/*.xml which cases they held. A
program that failed without a failed case (a crash, a time-out, a rostest whose node died) is a case itself.
"""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def outcome(case):
    if case.find("failure") is not None or case.find("error") is not None:
        return "failed"
    return "skipped" if case.find("skipped") is not None or case.get("status") == "notrun" else "passed"


def cases_in(path):
    """(outcome, name) of each case of a result file; none if the program died before it wrote one."""
    if not path.exists():
        return []
    try:
        cases = ElementTree.parse(path).iter("testcase")
    except ElementTree.ParseError:
        return []
    return [(outcome(case), f'{case.get("classname")}.{case.get("name")}') for case in cases]


def cases_of_rostest(results, path):
    """The cases of a rostest's programs; a program without cases of its own (hztest, for one) is one case."""
    cases = []
    for result, name in cases_in(path):
        program = name.split(".")[-1][len("test"):]
        own = cases_in(results / f"rosunit-{program}.xml")
        if not own or (result == "failed" and all(inner != "failed" for inner, _ in own)):
            own.append((result, program))
        cases += own
    return cases


def cases_of_program(results, program):
    """`program` is a name of ctest's: TARGET, or with catkin _ctest_sightline_gtest_TARGET."""
    name = program.replace("_ctest_sightline_", "", 1)
    if name.startswith("rostest_"):
        return cases_of_rostest(results, results / f'rostest-{name[len("rostest_"):].rsplit(".", 1)[0]}.xml')
    return cases_in(results / f'gtest-{name.replace("gtest_", "", 1)}.xml')


def main():
    build = pathlib.Path(sys.argv[1])
    for run in ElementTree.parse(build / "ctest.xml").iter("testcase"):
        cases = cases_of_program(build / "test_results/sightline", run.get("name"))
        if not cases or (outcome(run) == "failed" and all(result != "failed" for result, _ in cases)):
            cases.append((outcome(run), "the program"))
        for result, name in cases:
            print(result, f'{run.get("name").split("test_", 1)[-1]} {name}')


if __name__ == "__main__":
    main()
