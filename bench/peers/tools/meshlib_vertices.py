"""MeshLib's findMaxDistanceSqOneWay: the farthest vertex, in single precision."""

TITLE = "MeshLib"
PACKAGE = "meshlib"
KIND = "vertices"
PRECISION = "single"


def prepare(a, b, tolerance, samples):
    import meshlib.mrmeshnumpy as arrays
    import meshlib.mrmeshpy as meshlib
    return meshlib, *(arrays.meshFromFacesVerts(faces, vertices) for vertices, faces in (a, b))


def forget(prepared):
    for mesh in prepared[1:]:
        mesh.invalidateCaches()  # its tree


def measure(prepared):
    meshlib, a, b = prepared
    # Measured from the vertices of the second argument to the first.
    return meshlib.findMaxDistanceSqOneWay(meshlib.MeshPart(b), meshlib.MeshPart(a)) ** 0.5
