"""What a case can have made for it: `make KIND NAME [WORDS]` in its `expect`.

Small broken files lie in the case's folder as they are; here are those that would be large, that are binary, or that no
repository keeps (links, permissions).
"""
import functools
import json
import math
import os
import struct

PROFILE = [(-4, 0), (-4, 3), (-3, 5), (0, 6), (3, 5), (4, 3), (4, 0), (-4, 0)]


@functools.lru_cache
def tunnel_points(scale=1.0):
    """The base job's tunnel as its scanner sees it (metres, scanner at the origin): 0.1 m outside the design line."""
    points = []
    for (x0, z0), (x1, z1) in zip(PROFILE, PROFILE[1:]):
        length = math.hypot(x1 - x0, z1 - z0)
        outside = (-(z1 - z0) / length, (x1 - x0) / length)
        for k in range(int(length / 0.09)):
            t = (k + 0.5) / int(length / 0.09)
            x = x0 + t * (x1 - x0) + 0.1 * outside[0]
            z = z0 + t * (z1 - z0) + 0.1 * outside[1] + 100.4 - 102.0
            for row in range(-110, 110):
                rough = 0.004 * math.sin(37.1 * row + 11.3 * k)
                points.append((scale * (x + rough * outside[0]), scale * 0.09 * (row + (k % 3) / 3), scale * (z + rough * outside[1])))
    return points


def lines_of(points):
    return "".join("%.4f %.4f %.4f\n" % p for p in points)


@functools.lru_cache
def tunnel_text(scale):
    return lines_of(tunnel_points(scale))


def tunnel(path, scale="1", names=""):
    path.write_text((names + "\n" if names else "") + tunnel_text(float(scale)))


def first_points(path, count):
    path.write_text(lines_of(tunnel_points()[: int(count)]))


def with_decimal_commas(path):
    path.write_text(lines_of(tunnel_points()[:200]).replace(".", ",").replace(" ", ";"))


def copied_points(path, count, words):
    """The same point again and again."""
    path.write_text((words + "\n") * int(count))


PLY_HEAD = "ply\nformat binary_little_endian 1.0\nelement vertex %s\nproperty float x\nproperty float y\nproperty float z\nend_header\n"


def ply(path, claimed=None, kept=None):
    """A binary PLY; `claimed` points in the header, `kept` bytes of the file."""
    points = tunnel_points()[:500]
    data = (PLY_HEAD % (claimed if claimed not in (None, "true") else len(points))).encode()
    data += b"".join(struct.pack("<3f", *p) for p in points)
    path.write_bytes(data[: int(kept)] if kept else data)


def ply_of_nan(path):
    path.write_bytes((PLY_HEAD % 300).encode() + struct.pack("<3f", math.nan, math.inf, -math.inf) * 300)


def pcd(path, claimed=None, kept=None):
    points = tunnel_points()[:500]
    count = claimed if claimed not in (None, "true") else len(points)
    head = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH %s\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS %s\nDATA binary\n" % (count, count)
    data = head.encode() + b"".join(struct.pack("<3f", *p) for p in points)
    path.write_bytes(data[: int(kept)] if kept else data)


def las(path, claimed=None, kept=None):
    """LAS 1.2, point format 0."""
    points = tunnel_points()[:500]
    count = int(claimed) if claimed not in (None, "true") else len(points)
    head = struct.pack("<4sHHIHH8sBB32s32sHHHIIBHI5I", b"LASF", 0, 0, 0, 0, 0, b"", 1, 2, b"Adit", b"tests", 1, 2026, 227, 227, 0, 0, 20,
                       count, count, 0, 0, 0, 0)
    head += struct.pack("<12d", 0.001, 0.001, 0.001, 0, 0, 0, 6, -6, 12, -12, 6, -6)
    body = b"".join(struct.pack("<3iHBBbBH", *(round(c * 1000) for c in p), 0, 9, 2, 0, 0, 0) for p in points)
    data = head + body
    path.write_bytes(data[: int(kept)] if kept else data)


def laz(path):
    """Plain points under the mark of compressed ones."""
    las(path)
    data = bytearray(path.read_bytes())
    data[104] |= 0x80
    path.write_bytes(data)


def folder(path):
    path.mkdir(parents=True)


def link(path, to):
    path.symlink_to(to)


def pipe(path):
    os.mkfifo(path)


def nothing(path):
    path.write_bytes(b"")


def hexadecimal(path, *words):
    path.write_bytes(bytes.fromhex("".join(words)))


def bytes_in_front(path, *words):
    path.write_bytes(bytes.fromhex("".join(words)) + path.read_bytes())


def windows_lines(path):
    path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))


def moved(path, to):
    target = path.parent / to
    target.parent.mkdir(parents=True, exist_ok=True)
    path.rename(target)


def removed(path):
    path.unlink()


def unreadable(path):
    path.chmod(0)


def without_writing(path):
    path.chmod(0o555)


def closed_brackets(path, count):
    path.write_text('{"adit": 1, "scans": %s%s}' % ("[" * int(count), "]" * int(count)))


def long_scan_name(path):
    content = json.loads(path.read_text())
    content["scans"][0]["name"] = "S" * 5000
    path.write_text(json.dumps(content))


def carriage_returns(path):
    path.write_bytes(path.read_bytes().replace(b"\n", b"\r"))


def pcd_from_afar(path):
    points = "".join("%d %d %d\n" % (i % 7, i % 5, i % 3) for i in range(60))
    path.write_text("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 60\nHEIGHT 1\nVIEWPOINT 1e20 0 0 1 0 0 0\n"
                    "POINTS 60\nDATA ascii\n" + points)


def nested_brackets(path, count):
    path.write_text('{"adit": 1, "scans": ' + "[" * int(count))


def nested_elements(path, count):
    path.write_text("<LandXML>" + "<a>" * int(count))


KINDS = {f.__name__: f for f in (tunnel, first_points, with_decimal_commas, copied_points, ply, ply_of_nan, pcd, las, laz, folder, link, pipe,
                                 nothing, hexadecimal, bytes_in_front, windows_lines, moved, removed, unreadable, without_writing,
                                 nested_brackets, nested_elements, closed_brackets, long_scan_name, carriage_returns,
                                 pcd_from_afar)}
