"""Reads STL and OBJ as another program would, and measures the triangles."""

import struct


def read_binary_stl(path):
    """Triangles, each three points; the facet normals beside them."""
    data = path.read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * count, "the length doesn't fit the number of triangles"
    triangles, normals = [], []
    for i in range(count):
        numbers = struct.unpack_from("<12f", data, 84 + 50 * i)
        normals.append(numbers[:3])
        triangles.append((numbers[3:6], numbers[6:9], numbers[9:12]))
    return triangles, normals


def read_ascii_stl(path):
    words = path.read_text().split()
    assert words[0] == "solid" and "endsolid" in words
    points = [tuple(map(float, words[i + 1:i + 4])) for i, word in enumerate(words) if word == "vertex"]
    return [tuple(points[i:i + 3]) for i in range(0, len(points), 3)]


def read_obj(path):
    points, triangles = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            triangles.append(tuple(points[int(word.split("/")[0]) - 1] for word in words[1:]))
    return triangles


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def normal(triangle):
    """Twice the area, along the normal."""
    return cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]))


def area(triangles):
    return sum(0.5 * dot(normal(t), normal(t)) ** 0.5 for t in triangles)


def volume(triangles):
    """Signed; of a closed mesh."""
    return sum(dot(t[0], cross(t[1], t[2])) / 6.0 for t in triangles)


def is_closed(triangles):
    """Every edge is used twice, once in each direction, corners being the same where their coordinates are."""
    edges = set()
    for t in triangles:
        for i in range(3):
            edge = (t[i], t[(i + 1) % 3])
            if edge in edges:
                return False
            edges.add(edge)
    return all((b, a) in edges for a, b in edges)


def box(triangles):
    points = [p for t in triangles for p in t]
    return [min(p[i] for p in points) for i in range(3)], [max(p[i] for p in points) for i in range(3)]
