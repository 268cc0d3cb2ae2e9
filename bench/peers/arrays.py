"""Meshes as arrays in a file: two 64-bit counts, then 3 doubles for each vertex, then 3 32-bit indices for each face.

What every worker reads, in no time and without a parser of its own, so that all programs get the same doubles.
"""

import array
import struct


def write(path, vertices, faces):
    """Writes rows of 3 floats and rows of 3 indices, counted from 0."""
    with open(path, "wb") as file:
        file.write(struct.pack("<qq", len(vertices), len(faces)))
        array.array("d", (x for row in vertices for x in row)).tofile(file)
        array.array("i", (i for row in faces for i in row)).tofile(file)


def from_obj(obj, path):
    """Reads an OBJ file as `pompeiu convert` writes it, with triangles only, and writes its arrays."""
    vertices, faces = [], []
    with open(obj) as lines:
        for line in lines:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(word) for word in words[1:4]])
            elif words[:1] == ["f"]:
                if len(words) != 4:
                    raise ValueError(f"{obj}: a face of {len(words) - 1} corners; expected triangles")
                faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    write(path, vertices, faces)
    return len(vertices), len(faces)


def write_obj(path, vertices, faces):
    """Writes an OBJ file; every double reads back as itself."""
    with open(path, "w") as file:
        file.writelines("v {!r} {!r} {!r}\n".format(*row) for row in vertices)
        file.writelines("f {} {} {}\n".format(*(i + 1 for i in row)) for row in faces)
