"""Renders with kernels of a folder, and reads and writes the pictures: what the tests of exercise 10 run on."""
import os
import re
import resource
import shutil
import struct
import subprocess
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent.parent
PROGRAM = os.environ.get("RECTRAY", str(ROOT / "build" / "rectray"))
SECONDS = 6  # of processor time, for compiling a kernel and running it


class Fails(Exception):
    """How the device ended: what is told, and whether it was the time."""

    def __init__(self, said, slow=False):
        super().__init__(said)
        self.slow = slow


class NotCompiled(Exception):
    """What the compiler says."""


def limits():
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 1))


def render(folder, scene, columns, rows, *options):
    """What `rectray render` writes with the kernels of a folder."""
    environment = {**os.environ, "RECTRAY_KERNELS": str(folder), "RECTRAY_CACHE_DIR": ""}
    command = [PROGRAM, "render", str(ROOT / scene), "--kernel", "plain", "--arithmetic", "textbook", "-a", "none",
               "--precision", "double", "--size", f"{columns}x{rows}", "-q", "-o", "-", *options]
    try:
        out = subprocess.run(command, capture_output=True, env=environment, preexec_fn=limits, timeout=20 * SECONDS,
                             check=False)
    except subprocess.TimeoutExpired as error:
        raise Fails("it does not come to an end", slow=True) from error
    said = out.stderr.decode(errors="replace")
    if out.returncode in (-24, -9):
        raise Fails("it does not come to an end", slow=True)
    if out.returncode < 0:
        raise Fails("it follows a pointer that leads nowhere")
    if "do not compile" in said:
        lacking = re.findall(r"plain.cl.*undeclared identifier '(\w+)'", said)
        raise NotCompiled("\n".join(line for line in said.splitlines() if "mine.cl" in line) or
                          "\n".join(f"it has no function {name}" for name in lacking) or said)
    if out.returncode != 0:
        raise Fails(said.strip())
    return out.stdout


def kernels_with(folder, plain, **files):
    """A copy of our kernels with that text for plain.cl, and other files beside it."""
    shutil.copytree(ROOT / "kernels", folder)
    for name, text in {"plain": plain, **files}.items():
        (folder / f"{name}.cl").write_text(text, encoding="utf-8")
    return folder


def pfm_pixels(data):
    """The colours of a PFM file, from the top."""
    head, columns_rows, _, rest = data.split(b"\n", 3)
    columns, rows = map(int, columns_rows.split())
    assert head == b"PF"
    values = struct.unpack(f"<{3 * columns * rows}f", rest)
    lines = [values[3 * columns * row:3 * columns * (row + 1)] for row in range(rows)]
    return [line[3 * k:3 * k + 3] for line in reversed(lines) for k in range(columns)]


def ppm_pixels(data):
    _, columns_rows, _, rest = data.split(b"\n", 3)
    columns, rows = map(int, columns_rows.split())
    assert len(rest) == 3 * columns * rows
    return [tuple(rest[3 * k:3 * k + 3]) for k in range(columns * rows)]


def write_png(path, columns, rows, pixels):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    lines = b"".join(b"\0" + bytes(value for pixel in pixels[row * columns:(row + 1) * columns] for value in pixel)
                     for row in range(rows))
    Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0))
                           + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))
