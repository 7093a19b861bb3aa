#!/usr/bin/env python3
"""Draws a run's fields with VTK's own reader: von Mises stress on the displaced mesh, off-screen, to PNG.

usage: render_fields.py FIELDS OUT.png [--index N] [--warp F] [--at X Y HEIGHT] [--size W H] [--edges]
FIELDS    the fields folder of a run, or a .pvd of it (default wear.pvd)
--index   which file of the series, 0 the first [default: -1, the last]
--warp    factor on the displacements [default: 10]
--at      centre and height of the view, mm [default: around the contact with the largest pressure]
--edges   draw the edges of the elements
--range   largest stress of the colours, MPa [default: 99.95th percentile in the view]
needs: pip install vtk                        without it: prints 'skipped: ...' and succeeds
"""
import argparse
import pathlib
import struct
import sys
import zlib
import xml.etree.ElementTree as ElementTree

try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    print("skipped: vtk not installed")
    sys.exit(0)

# Perceptually even and dark on white at its upper end: from ColorBrewer's YlOrRd, with a light grey for no stress.
COLOURS = ((0.90, 0.91, 0.92), (1.00, 0.93, 0.63), (1.00, 0.70, 0.30), (0.94, 0.23, 0.13), (0.50, 0.00, 0.15))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("fields", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--index", type=int, default=-1)
    parser.add_argument("--warp", type=float, default=10.0)
    parser.add_argument("--at", type=float, nargs=3)
    parser.add_argument("--size", type=int, nargs=2, default=(1000, 640))
    parser.add_argument("--edges", action="store_true")
    parser.add_argument("--range", type=float)
    arguments = parser.parse_args()

    series = arguments.fields if arguments.fields.is_file() else arguments.fields / "wear.pvd"
    entries = ElementTree.parse(series).getroot().findall("./Collection/DataSet")
    entry = entries[arguments.index]
    grid = read(series.parent / entry.get("file"))
    stress = array(grid, "von_mises")
    if not np.isfinite(stress).all() or stress.max() <= 0.0:
        raise SystemExit(f"{entry.get('file')}: von_mises is not a stress")

    places = vtk_to_numpy(grid.GetPoints().GetData())
    if arguments.at:
        x, y, height = arguments.at
    else:
        x, y = places[np.argmax(array(grid, "contact_pressure"))][:2]
        height = 0.11 * np.ptp(places[:, 1])
    half = 0.5 * height * np.array((arguments.size[0] / arguments.size[1], 1.0))
    seen = (np.abs(places[:, :2] - (x, y)) < half).all(axis=1)
    top = arguments.range or float(np.percentile(stress[seen], 99.95))

    draw(warped(grid, arguments.warp), top, (x, y, height), arguments)
    time = float(entry.get("timestep"))
    print(f"{arguments.out}: {entry.get('file')}, time {time:g}, von Mises 0 to {top:.0f} MPa, displacements x{arguments.warp:g}")


def read(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def array(grid, name):
    return vtk_to_numpy(grid.GetPointData().GetArray(name))


def warped(grid, factor):
    """The displaced mesh. A rigid turn of the pinion belongs to the displacement, so the contact stays closed."""
    warp = vtk.vtkWarpVector()
    warp.SetInputData(grid)
    warp.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "displacement")
    warp.SetScaleFactor(factor)
    warp.Update()
    return warp.GetOutput()


def draw(grid, top, view, arguments):
    colours = vtk.vtkColorTransferFunction()
    colours.SetColorSpaceToLab()
    for i, colour in enumerate(COLOURS):
        colours.AddRGBPoint(top * i / (len(COLOURS) - 1), *colour)

    surface = vtk.vtkGeometryFilter()
    surface.SetInputData(grid)
    mapper = vtk.vtkDataSetMapper()
    mapper.SetInputConnection(surface.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("von_mises")
    mapper.SetLookupTable(colours)
    mapper.UseLookupTableScalarRangeOn()
    mapper.InterpolateScalarsBeforeMappingOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    if arguments.edges:
        actor.GetProperty().EdgeVisibilityOn()
        actor.GetProperty().SetEdgeColor(0.45, 0.45, 0.48)
        actor.GetProperty().SetLineWidth(0.5)

    outline = vtk.vtkFeatureEdges()
    outline.SetInputConnection(surface.GetOutputPort())
    outline.BoundaryEdgesOn()
    outline.FeatureEdgesOff()
    outline.ManifoldEdgesOff()
    outline.ColoringOff()
    lines = vtk.vtkPolyDataMapper()
    lines.SetInputConnection(outline.GetOutputPort())
    lines.ScalarVisibilityOff()
    border = vtk.vtkActor()
    border.SetMapper(lines)
    border.GetProperty().SetColor(0.15, 0.15, 0.2)
    border.GetProperty().SetLineWidth(1.5)
    border.GetProperty().LightingOff()

    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetNumberOfLabels(3)
    version = vtk.vtkVersion()
    recent = (version.GetVTKMajorVersion(), version.GetVTKMinorVersion()) >= (9, 6)
    bar.SetLabelFormat("{:.0f}" if recent else "%.0f")
    bar.UnconstrainedFontSizeOn()
    bar.SetOrientationToHorizontal()
    bar.SetPosition(0.62, 0.03)
    bar.SetPosition2(0.34, 0.09)
    bar.DrawBackgroundOn()
    bar.GetBackgroundProperty().SetColor(1.0, 1.0, 1.0)
    title = vtk.vtkTextActor()
    title.SetInput(" von Mises stress, MPa ")
    title.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    title.SetPosition(0.62, 0.125)
    title.GetTextProperty().SetBackgroundColor(1.0, 1.0, 1.0)
    title.GetTextProperty().SetBackgroundOpacity(1.0)
    for text in (title.GetTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0.1, 0.1, 0.15)
        text.ShadowOff()
        text.ItalicOff()
        text.BoldOff()
        text.SetFontSize(max(12, arguments.size[1] // 32))

    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    for prop in (actor, border):
        renderer.AddActor(prop)
    renderer.AddViewProp(bar)
    renderer.AddViewProp(title)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(view[0], view[1], 0.0)
    camera.SetPosition(view[0], view[1], 100.0)
    camera.SetParallelScale(0.5 * view[2])

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*arguments.size)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    write_png(arguments.out, grab.GetOutput())


def write_png(path, image):
    """A palette of 128 colours: a quarter of the size of true colours."""
    quantise = vtk.vtkImageQuantizeRGBToIndex()
    quantise.SetInputData(image)
    quantise.SetNumberOfColors(128)
    quantise.Update()
    output = quantise.GetOutput()
    width, height, _ = output.GetDimensions()
    indices = vtk_to_numpy(output.GetPointData().GetScalars()).astype(np.uint8).reshape(height, width)[::-1]
    table = quantise.GetLookupTable()
    palette = bytes(round(255 * c) for i in range(table.GetNumberOfTableValues()) for c in table.GetTableValue(i)[:3])

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)
    rows = b"".join(b"\0" + row.tobytes() for row in indices)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"PLTE", palette) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
    )


if __name__ == "__main__":
    main()
