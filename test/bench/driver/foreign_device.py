#!/usr/bin/python3
"""A synchronised-scan sensor written from docs/wire_format.md alone, at a pseudo terminal.

usage: foreign_device.py LINK

Plays its faults one after the other and ends. Prints a line for every scan that went onto the line whole:
`scan ID STAMP_NS PHASE`, the stamp being the time of the first sample by the clock of this machine. ID is told by the
currents of the first sample. Phases in which no scan may be published begin with `bad`.
"""
import binascii
import os
import select
import struct
import sys
import termios
import time
import tty

SAMPLES = 256
PERIOD = 400_000  # [ns]
BAUD = 460_800
FA = 50  # in a count
END = 8_388_607


def crc16(data):
    crc = 0xFFFF
    for byte in data:
        crc ^= byte << 8
        for _ in range(8):
            crc = (crc << 1 ^ 0x1021 if crc & 0x8000 else crc << 1) & 0xFFFF
    return crc


def i24(value):
    return struct.pack("<i", value)[:3]


def now():
    return time.clock_gettime_ns(time.CLOCK_REALTIME)


class Device:
    def __init__(self, link):
        self.link = link
        self.master = None
        self.scanning = False
        self.sequence = 0
        self.identity = 0
        self.line_free = 0
        self.incoming = b""
        self.acknowledge_after = 0.0
        self.waiting = []
        self.usb = False
        self.stuck_clock = None
        self.period = PERIOD
        self.samples = SAMPLES
        self.saturated = 0
        self.boot_anew()
        self.plug_in()

    # --- clock and line ---
    def boot_anew(self):
        self.boot = int.from_bytes(os.urandom(4), "little")
        self.origin = now() - int.from_bytes(os.urandom(2), "little") * 1_000_000
        self.number = 0
        self.scanning = False

    def clock(self, at):
        return (at - self.origin) // 1000 & 0xFFFFFFFF

    def plug_in(self):
        self.master, slave = os.openpty()
        tty.setraw(self.master)
        tty.setraw(slave)
        os.set_blocking(self.master, False)
        self.slave = slave  # kept open: else the terminal hangs up before the host comes
        if os.path.islink(self.link):
            os.unlink(self.link)
        os.symlink(os.ttyname(slave), self.link)

    def pull_out(self):
        os.unlink(self.link)
        os.close(self.slave)
        os.close(self.master)
        self.incoming = b""

    def write(self, data):
        while data:
            try:
                data = data[os.write(self.master, data):]
            except BlockingIOError:
                if now() > self.line_free + 1_000_000_000:
                    return
                time.sleep(0.001)

    def frame(self, kind, payload, at):
        self.sequence = self.sequence + 1 & 0xFFFF
        clock = self.clock(at) if self.stuck_clock is None else self.stuck_clock
        header = struct.pack("<BBHHI", 1, kind, self.sequence, len(payload), clock)
        body = header + struct.pack("<H", crc16(header)) + payload
        return b"SL" + body + struct.pack("<I", binascii.crc32(body))

    def send(self, kind, payload):
        """Waits until the last byte would have gone; the write comes then, or at once by USB."""
        begin = max(now(), self.line_free)
        data = self.frame(kind, payload, begin)
        duration = 0 if self.usb else len(data) * 10 * 1_000_000_000 // BAUD
        self.line_free = begin + duration
        self.listen_until(self.line_free)
        self.write(data)

    # --- answers ---
    def listen_until(self, moment):
        while True:
            left = moment - now()
            self.answer_waiting()
            if left <= 0:
                return
            if self.master and select.select([self.master], [], [], min(left, 2_000_000) * 1e-9)[0]:
                self.receive()

    def receive(self):
        try:
            self.incoming += os.read(self.master, 4096)
        except OSError:
            return
        while True:
            begin = self.incoming.find(b"SL")
            if begin < 0 or len(self.incoming) < begin + 14:
                return
            frame = self.incoming[begin:]
            size = struct.unpack_from("<H", frame, 6)[0]
            if crc16(frame[2:12]) != struct.unpack_from("<H", frame, 12)[0]:
                self.incoming = frame[1:]
                continue
            if len(frame) < 18 + size:
                return
            self.incoming = frame[18 + size:]
            self.waiting.append((now(), frame[3], struct.unpack_from("<H", frame, 4)[0], frame[14:14 + size]))

    def answer_waiting(self):
        if self.line_free > now():
            return
        late = [entry for entry in self.waiting if entry[1] == 4 and now() - entry[0] < self.acknowledge_after * 1e9]
        due = [entry for entry in self.waiting if entry not in late]
        self.waiting = late
        for received, kind, sequence, payload in due:
            if kind == 1:
                self.send(0x81, self.identity_payload())
            elif kind == 5:
                self.send(0x83, payload + struct.pack("<I", self.clock(received)))
            else:
                if kind in (2, 3):
                    self.scanning = kind == 2
                self.send(0x82, struct.pack("<BBH", kind, 0, sequence))

    def identity_payload(self):
        return b"SYNC-SCAN".ljust(16, b"\0") + b"SS-0001".ljust(16, b"\0") + struct.pack("<BBHI", 2, 7, SAMPLES, self.boot)

    # --- scans ---
    def scan(self, phase, break_off=False):
        first = self.next_scan
        self.next_scan += self.samples * PERIOD
        self.number += 1
        self.listen_until(first + (self.samples - 1) * PERIOD)
        if not self.scanning:
            return
        self.identity += 1
        currents = b"".join(self.currents(i) for i in range(self.samples))
        angles = struct.pack("<%dh" % self.samples, *[0] * self.samples)
        status = 2 if self.saturated else 0
        head = struct.pack("<IIIIIHH", self.number, self.boot, self.clock(first), self.period, FA, status, self.samples)
        payload = head + angles + currents
        if break_off:
            self.write(self.frame(0x84, payload, now())[:1000])
            return
        self.send(0x84, payload)
        print("scan", self.identity, first, phase, flush=True)

    def currents(self, sample):
        """Of a wall about 1 m away; the first sample tells the scan."""
        if sample == 0:
            return i24(60_000 + self.identity) + i24(60_000)
        if self.saturated and 100 <= sample < 100 + self.saturated:
            return i24(END) + i24(END)
        return i24(100_000) + i24(100_000)

    def play(self, phase, seconds, **settings):
        for name, value in settings.items():
            setattr(self, name, value)
        end = now() + int(seconds * 1e9)
        self.next_scan = now()
        while now() < end:
            self.scan(phase)


def main():
    device = Device(sys.argv[1])
    device.play("begin", 6)
    device.play("saturated", 2, saturated=20)
    device.play("header_stuck", 3, saturated=0, stuck_clock=0)
    device.stuck_clock = None
    device.play("settled", 2)
    for step in (-5_000_000_000, -50_000_000, 50_000_000):
        device.origin -= step
        device.play("clock_set", 3)
    device.play("bad_samples", 3, samples=200)
    device.play("bad_period", 3, samples=SAMPLES, period=0)
    device.play("right_again", 2, period=PERIOD)
    for _ in range(3):
        device.boot_anew()
        device.send(0x81, device.identity_payload())
        device.play("rebooted", 2)
    device.write(os.urandom(40_000))
    device.play("after_garbage", 2)
    device.scan("half", break_off=True)
    device.pull_out()
    time.sleep(0.5)
    device.plug_in()
    device.play("plugged_in", 3)
    device.play("late_acknowledgements", 2, acknowledge_after=0.3)
    device.pull_out()
    time.sleep(0.5)
    device.plug_in()
    device.boot_anew()
    device.play("usb", 6, usb=True, acknowledge_after=0.0)
    time.sleep(0.5)  # or the end of the terminal would take the last scan with it


if __name__ == "__main__":
    main()
