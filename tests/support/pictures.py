"""Reads the formats that pictures are written in, for the tests: P6, PFM and PNG of 16 bits."""
import struct
import zlib


def ppm_values(data):
    """Columns, rows, the largest value, and the values of a P6."""
    magic, size, largest, rest = data.split(b"\n", 3)
    assert magic == b"P6"
    columns, rows = map(int, size.split())
    largest = int(largest)
    values = struct.unpack(f">{columns * rows * 3}{'H' if largest > 255 else 'B'}", rest)
    return columns, rows, largest, values


def pfm_values(data):
    """The rows of a PFM from the top, each a list of floats."""
    magic, size, scale, rest = data.split(b"\n", 3)
    assert magic == b"PF" and float(scale) == -1
    columns, rows = map(int, size.split())
    values = struct.unpack(f"<{columns * rows * 3}f", rest)
    return [values[row * 3 * columns:(row + 1) * 3 * columns] for row in reversed(range(rows))]


def png_16_bits(data):
    """The values of a PNG of 16 bits whose rows are unfiltered."""
    columns, rows, depth, kind = struct.unpack(">IIBB", data[16:26])
    assert (depth, kind) == (16, 2)
    raw, at = b"", 8
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at:at + 8])
        raw += data[at + 8:at + 8 + length] if name == b"IDAT" else b""
        at += length + 12
    raw, stride = zlib.decompress(raw), 6 * columns + 1
    lines = [raw[row * stride:(row + 1) * stride] for row in range(rows)]
    assert all(line[0] == 0 for line in lines)
    return [value for line in lines for value in struct.unpack(f">{3 * columns}H", line[1:])]
