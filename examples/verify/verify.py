"""Checks a certificate of the Pompeiu–Hausdorff distance with exact fractions, as the guide describes the format.

    python3 verify.py FILE A.obj B.obj

Slow and simple: for small meshes, OBJ with triangles. Exit code: 0 valid, 1 not, 2 unreadable.
"""

import gzip
import hashlib
import math
import struct
import sys
from fractions import Fraction

PLACES = 2**52


class Invalid(Exception):
    """A statement that is not true."""


class Unreadable(Exception):
    """No certificate."""


def read_obj(path):
    positions, faces = [], []
    for line in open(path, encoding="ascii"):
        words = line.split("#")[0].split()
        if words[:1] == ["v"]:
            positions.append(tuple(float(word) for word in words[1:4]))
        elif words[:1] == ["f"]:
            indices = [int(word.split("/")[0]) for word in words[1:]]
            if len(indices) != 3:
                raise Unreadable("a face that is no triangle")
            faces.append([i - 1 if i > 0 else len(positions) + i for i in indices])
    return [tuple(positions[i] for i in face) for face in faces]


def digest(mesh):
    numbers = (x + 0.0 for face in mesh for corner in face for x in corner)
    return hashlib.sha256(b"".join(struct.pack("<d", x) for x in numbers)).digest()


def minus(p, q):
    return [a - b for a, b in zip(p, q)]


def dot(p, q):
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


def cross(p, q):
    return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]


def exact(p):
    return [Fraction(x) for x in p]


def distance_sq(p, triangle):
    """The exact squared distance between a point and a triangle, which may be a segment or a point."""
    a, b, c = triangle
    candidates = []
    for start, end in [(a, b), (a, c), (b, c)]:
        edge, to = minus(end, start), minus(p, start)
        length_sq = dot(edge, edge)
        t = min(max(dot(to, edge) / length_sq, 0), 1) if length_sq else 0
        rest = [x - t * e for x, e in zip(to, edge)]
        candidates.append(dot(rest, rest))
    ab, ac, ap = minus(b, a), minus(c, a), minus(p, a)
    normal = cross(ab, ac)
    area_sq = dot(normal, normal)
    if area_sq:
        v, w = dot(cross(ap, ac), normal), dot(cross(ab, ap), normal)
        if v >= 0 and w >= 0 and v + w <= area_sq:
            candidates.append(dot(normal, ap) ** 2 / area_sq)
    return min(candidates)


class Corner:
    """An exact point, and its offset in doubles, which only says where planes cross."""

    def __init__(self, point, offset):
        self.point, self.offset = point, offset

    def between(self, other, t):
        s = 1.0 - t
        exact_t = Fraction(t)
        point = [(1 - exact_t) * p + exact_t * q for p, q in zip(self.point, other.point)]
        return Corner(point, [s * p + t * q for p, q in zip(self.offset, other.offset)])


def part(polygon, start, end):
    (i, s), (j, t), n = start, end, len(polygon)

    def at(side, place):
        return polygon[side] if place == 0 else polygon[side].between(polygon[(side + 1) % n], place)

    corners = [at(i, s)]
    while i != j:
        i = (i + 1) % n
        corners.append(polygon[i])
    if t != 0:
        corners.append(at(j, t))
    if len(corners) > 64:
        raise Unreadable("a polygon with more than 64 corners")
    return corners


class Block:
    def __init__(self, data):
        self.data, self.at, self.last, self.run = data, 0, 0, 0

    def byte(self):
        if self.at >= len(self.data):
            raise Unreadable("a block that ends in the middle of a tree")
        self.at += 1
        return self.data[self.at - 1]

    def number(self):
        value = 0
        for shift in range(0, 63, 7):
            byte = self.byte()
            value |= (byte & 127) << shift
            if byte < 128:
                return value
        raise Unreadable("a number that is too long")

    def place(self, count):
        value = 0
        for _ in range(count):
            value = 256 * value + self.byte()
        t = value / (PLACES if count == 7 else 256**count)
        if t >= 1:
            raise Unreadable("a position beyond its side")
        return t

    def move(self, z, faces):
        self.last += z // 2 if z % 2 == 0 else -(z + 1) // 2
        if not 0 <= self.last < faces:
            raise Unreadable("a face that is not there")


def crossing(face, side, polygon):
    edge = minus(face[(side + 1) % 3], face[side])
    inward = cross(cross(minus(face[1], face[0]), minus(face[2], face[0])), edge)
    heights = [dot(inward, minus(corner.offset, face[side])) for corner in polygon]
    found = {}
    for i, height in enumerate(heights):
        following = heights[(i + 1) % len(heights)]
        if (height >= 0) != (following >= 0):
            t = math.floor(height / (height - following) * PLACES) / PLACES
            if (following >= 0) in found:
                raise Unreadable("a plane that crosses more than once")
            found[following >= 0] = (i, t) if t < 1 else ((i + 1) % len(heights), 0.0)
    if len(found) < 2 or found[False][0] == found[True][0]:
        raise Unreadable("a plane that does not cross")
    return found[False], found[True]


def check_tree(block, number, face, b, limit_sq):
    origin = face[0]
    waiting = [[Corner(exact(p), minus(p, origin)) for p in face]]
    untouched, cells = True, 0
    while waiting:
        polygon = waiting.pop()
        if block.run > 0:
            block.run -= 1
        else:
            code = block.number()
            kind, rest, n = code % 4, code // 4, len(polygon)
            if kind == 3:
                raise Unreadable("a node of no kind")
            if kind == 1:
                i, j = divmod(rest // 64, n)
                if not i < j < n:
                    raise Unreadable("a chord between sides that are not there")
                s, t = block.place(rest // 8 % 8), block.place(rest % 8)
                waiting += [part(polygon, (j, t), (i, s)), part(polygon, (i, s), (j, t))]
                untouched = False
                if len(waiting) > 1000:
                    raise Unreadable("a tree that is too deep")
                continue
            block.move(rest // 8 if kind == 2 else rest, len(b))
            seen = [minus(p, origin) for p in b[block.last]]
            for side in range(3):
                if kind == 2 and rest >> side & 1:
                    out, back = crossing(seen, side, polygon)
                    waiting.append(part(polygon, out, back))
                    if len(waiting) > 1000:
                        raise Unreadable("a tree that is too deep")
                    polygon = part(polygon, back, out)
            if untouched and code == 0:
                block.run = block.number()
        untouched = False
        near = [exact(p) for p in b[block.last]]
        for corner in polygon:
            if distance_sq(corner.point, near) > limit_sq:
                raise Invalid(f"cell {cells} of face {number} of A is not near face {block.last} of B")
        cells += 1


def check_direction(data, at, a, b):
    lower, upper, witness, *weights = struct.unpack_from("<ddIddd", data, at)
    at += 44
    if not (0 <= lower < math.inf and 0 <= upper < math.inf):
        raise Invalid("the claim is no interval")
    if lower > 0:
        weights = exact(weights)
        total = sum(weights)
        if witness >= len(a) or min(weights) < 0 or not Fraction(1e-250) <= total <= Fraction(1e250):
            raise Invalid("the witness is no point of A")
        point = [sum(w * Fraction(p[k]) for w, p in zip(weights, a[witness])) / total for k in range(3)]
        for number, face in enumerate(b):
            if distance_sq(point, [exact(p) for p in face]) < Fraction(lower) ** 2:
                raise Invalid(f"the witness is not far from face {number} of B")
    for first in range(0, len(a), 4096):
        (length,) = struct.unpack_from("<I", data, at)
        block = Block(data[at + 4 : at + 4 + length])
        at += 4 + length
        if at > len(data):
            raise Unreadable("an early end")
        for number in range(first, min(first + 4096, len(a))):
            check_tree(block, number, a[number], b, Fraction(upper) ** 2)
        if block.run or block.at != len(block.data):
            raise Unreadable("more than the trees of its faces")
    return at, (lower, upper)


def check(data, a, b):
    if data[:8] != b"PHCERT1\n" or len(data) < 73 or data[72] not in (1, 2, 3):
        raise Unreadable("another beginning than that of a certificate")
    for name, mesh, start in (("A", a, 8), ("B", b, 40)):
        if digest(mesh) != data[start : start + 32]:
            raise Invalid(f"mesh {name} is not the one that was certified")
    at, claims = 73, {}
    for bit, name, meshes in ((1, "h(A, B)", (a, b)), (2, "h(B, A)", (b, a))):
        if data[72] & bit:
            at, claims[name] = check_direction(data, at, *meshes)
    if at != len(data):
        raise Unreadable("bytes after its end")
    return claims


def main():
    try:
        certificate, a, b = sys.argv[1:]
        with open(certificate, "rb") as file:
            data = file.read()
            claims = check(gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data, read_obj(a), read_obj(b))
    except Invalid as reason:
        print(f"invalid: {reason}")
        return 1
    except (Unreadable, OSError, ValueError, struct.error) as reason:
        print(f"error: {reason}", file=sys.stderr)
        return 2
    for name, (lower, upper) in claims.items():
        print(f"{lower!r} <= {name} <= {upper!r}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
