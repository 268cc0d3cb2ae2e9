"""MeshLab's filter get_hausdorff_distance: the farthest of vertices, points of edges and random points of faces."""

TITLE = "PyMeshLab"
PACKAGE = "pymeshlab"
KIND = "samples"


def prepare(a, b, tolerance, samples):
    import pymeshlab
    meshes = pymeshlab.MeshSet(verbose=False)
    for mesh in (a, b):
        meshes.add_mesh(pymeshlab.Mesh(*mesh))
    return pymeshlab, meshes, samples


def measure(prepared):
    pymeshlab, meshes, samples = prepared
    return meshes.get_hausdorff_distance(
        sampledmesh=0, targetmesh=1, samplevert=True, sampleedge=True, sampleface=True, samplenum=samples,
        maxdist=pymeshlab.PercentageValue(100))["max"]
