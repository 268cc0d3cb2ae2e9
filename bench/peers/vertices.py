"""Which vertices of a mesh belong to its surface."""


def of_faces(mesh):
    """Vertices that a face uses: the others are no part of a surface, and asking for them would be our mistake."""
    import numpy
    vertices, faces = mesh
    return vertices[numpy.unique(faces)]
