"""Writes the files in this folder with VTK (run once, with VTK 9.7.2; tests read the files as they are).

Points of a cube and above it; a vertex, a line, three quadrilaterals, a triangle and a strip of two triangles.
"""

import vtk

points = vtk.vtkPoints()
points.SetDataTypeToDouble()
for x, y, z in [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.1, 0.2, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1), (0.5, 0.5, -1e-7)]:
    points.InsertNextPoint(x, y, z)
single = vtk.vtkPoints()
single.SetDataTypeToFloat()
single.DeepCopy(points)

CELLS = [
    (vtk.VTK_VERTEX, [8]),
    (vtk.VTK_LINE, [0, 8]),
    (vtk.VTK_QUAD, [0, 3, 2, 1]),
    (vtk.VTK_TRIANGLE, [4, 5, 6]),
    (vtk.VTK_QUAD, [0, 1, 5, 4]),
    (vtk.VTK_POLYGON, [1, 2, 6, 5]),
    (vtk.VTK_TRIANGLE_STRIP, [2, 3, 6, 7]),
]


def attach(data):
    for owner, count in [(data.GetPointData(), 9), (data.GetCellData(), 7)]:
        array = vtk.vtkDoubleArray()
        array.SetName("with a name")
        for i in range(count):
            array.InsertNextValue(i / 3)
        owner.AddArray(array)
    time = vtk.vtkDoubleArray()
    time.SetName("TimeValue")
    time.InsertNextValue(0.25)
    data.GetFieldData().AddArray(time)
    return data


poly = vtk.vtkPolyData()
arrays = {kind: vtk.vtkCellArray() for kind in ("Verts", "Lines", "Polys", "Strips")}
grid = vtk.vtkUnstructuredGrid()
for kind, corners in CELLS:
    name = {vtk.VTK_VERTEX: "Verts", vtk.VTK_LINE: "Lines", vtk.VTK_TRIANGLE_STRIP: "Strips"}.get(kind, "Polys")
    arrays[name].InsertNextCell(len(corners), corners)
    grid.InsertNextCell(kind, len(corners), corners)
# A pixel has its corners row by row: the same square as [4, 5, 6, 7] round.
grid.InsertNextCell(vtk.VTK_PIXEL, 4, [4, 5, 7, 6])
for name, array in arrays.items():
    getattr(poly, "Set" + name)(array)
poly.SetPoints(points)
grid.SetPoints(points)
attach(poly)
attach(grid)

for data, writer_class, name in [
    (poly, vtk.vtkPolyDataWriter, "poly"),
    (grid, vtk.vtkUnstructuredGridWriter, "grid"),
]:
    for version, label in [(42, "4.2"), (51, "5.1")]:
        for binary in (False, True):
            writer = writer_class()
            writer.SetInputData(data)
            writer.SetFileVersion(version)
            writer.SetFileType(2 if binary else 1)
            writer.SetFileName(f"{name}-{label}-{'binary' if binary else 'ascii'}.vtk")
            writer.Write()

for data, writer_class, suffix in [
    (poly, vtk.vtkXMLPolyDataWriter, "vtp"),
    (grid, vtk.vtkXMLUnstructuredGridWriter, "vtu"),
]:
    for name, mode, encoded, compressed, wide, big in [
        ("ascii", "Ascii", True, False, False, False),
        ("inline", "Binary", True, False, False, False),
        ("inline-zlib", "Binary", True, True, True, False),
        ("appended-base64", "Appended", True, False, True, False),
        ("appended-base64-zlib", "Appended", True, True, False, True),
        ("appended-raw", "Appended", False, False, False, True),
        ("appended-raw-zlib", "Appended", False, True, True, False),
    ]:
        writer = writer_class()
        writer.SetInputData(data)
        getattr(writer, f"SetDataModeTo{mode}")()
        writer.SetEncodeAppendedData(encoded)
        writer.SetCompressorTypeToZLib() if compressed else writer.SetCompressorTypeToNone()
        # Several blocks to an array.
        writer.SetBlockSize(64)
        writer.SetHeaderTypeToUInt64() if wide else writer.SetHeaderTypeToUInt32()
        writer.SetByteOrderToBigEndian() if big else writer.SetByteOrderToLittleEndian()
        writer.SetFileName(f"{name}.{suffix}")
        writer.Write()

notes = vtk.vtkStringArray()
notes.SetName("notes")
for note in ["short", "x" * 100, "", "two words\nand a line", "y" * 20000]:
    notes.InsertNextValue(note)
bits = vtk.vtkBitArray()
bits.SetName("bits")
for i in range(11):
    bits.InsertNextValue(i % 2)
poly.GetFieldData().AddArray(notes)
poly.GetFieldData().AddArray(bits)
for kind in ("ascii", "binary"):
    writer = vtk.vtkPolyDataWriter()
    writer.SetInputData(poly)
    writer.SetFileType(2 if kind == "binary" else 1)
    writer.SetFileName(f"poly-strings-{kind}.vtk")
    writer.Write()
poly.GetFieldData().Initialize()

poly.SetPoints(single)
writer = vtk.vtkXMLPolyDataWriter()
writer.SetInputData(poly)
writer.SetCompressorTypeToLZ4()
writer.SetFileName("lz4.vtp")
writer.Write()
writer = vtk.vtkPolyDataWriter()
writer.SetInputData(poly)
writer.SetFileName("single.vtk")
writer.SetFileTypeToBinary()
writer.Write()
