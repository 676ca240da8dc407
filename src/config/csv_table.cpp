#include "sightline/config/csv_table.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>

#include "sightline/config/text_file.h"

namespace sightline::config {

namespace {

const char* const kByteOrderMark = "\xEF\xBB\xBF";  // what spreadsheets begin UTF-8 with

std::string trimmed(const std::string& text) {
  const char* const blanks = " \t\r";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  for (std::size_t comma = line.find(','); comma != std::string::npos;
       comma = line.find(',', begin)) {
    cells.push_back(trimmed(line.substr(begin, comma - begin)));
    begin = comma + 1;
  }
  cells.push_back(trimmed(line.substr(begin)));
  return cells;
}

}  // namespace

CsvTable CsvTable::readFile(const std::string& path) {
  return parse(readText(path), path);
}

CsvTable CsvTable::parse(const std::string& text, const std::string& source) {
  CsvTable table(source);
  std::istringstream stream(text);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (number == 1 && line.rfind(kByteOrderMark, 0) == 0) line.erase(0, 3);
    line = trimmed(line);
    if (!line.empty() && line.front() != '#') table.add({number, cellsOf(line)});
  }
  if (table.header_.cells.empty()) throw Error(source, 0, "", "is empty: no line names columns");
  return table;
}

void CsvTable::add(Line line) {
  if (header_.cells.empty()) {
    header_ = std::move(line);
    checkHeader();
    return;
  }
  if (line.cells.size() != header_.cells.size()) {
    throw Error(source_, line.number, "",
                fmt::format("{} cells for {} columns", line.cells.size(), header_.cells.size()));
  }
  rows_.push_back(std::move(line));
}

void CsvTable::checkHeader() const {
  const auto& names = header_.cells;
  for (const std::string& name : names) {
    if (name.empty()) throw Error(source_, header_.number, "", "a column without a name");
    if (std::count(names.begin(), names.end(), name) > 1) {
      throw Error(source_, header_.number, name, "named twice");
    }
  }
}

bool CsvTable::has(const std::string& column) const {
  return std::find(header_.cells.begin(), header_.cells.end(), column) != header_.cells.end();
}

std::size_t CsvTable::indexOf(const std::string& column) const {
  const auto found = std::find(header_.cells.begin(), header_.cells.end(), column);
  if (found == header_.cells.end()) {
    throw Error(source_, header_.number, column,
                fmt::format("missing column; there are: {}", fmt::join(header_.cells, ", ")));
  }
  return static_cast<std::size_t>(found - header_.cells.begin());
}

const std::string& CsvTable::Row::text(const std::string& column) const {
  return table_->rows_[index_].cells[table_->indexOf(column)];
}

double CsvTable::Row::number(const std::string& column, Range range) const {
  const std::string& written = text(column);
  char* end = nullptr;
  const double value = std::strtod(written.c_str(), &end);
  if (written.empty() || *end != '\0' || !std::isfinite(value)) {
    fail(column, fmt::format("expected a number, found '{}'", written));
  }
  if (!range.contains(value)) fail(column, fmt::format("{} is outside {}", value, range.text()));
  return value;
}

int CsvTable::Row::integer(const std::string& column, Range range) const {
  const double value = number(column, range);
  if (value != std::floor(value) || std::abs(value) > 1e9) {
    fail(column, fmt::format("expected a whole number, found '{}'", text(column)));
  }
  return static_cast<int>(value);
}

void CsvTable::Row::fail(const std::string& column, const std::string& reason) const {
  throw Error(table_->source_, table_->rows_[index_].number, column, reason);
}

}  // namespace sightline::config
