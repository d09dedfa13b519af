"""Shows an export of orzo in ParaView: rods as capsules, coloured by speed, in translucent walls.

    orzo export runs/an6 --to vtk
    pvpython scenes/show_in_paraview.py runs/an6/export picture.png [TIME]

Without a display: xvfb-run -s "-screen 0 1280x1024x24" pvpython ... The same steps can be taken by hand in ParaView's window.
"""
import os
import sys

from paraview import simple as pv

STATIC = ("POINTS", "No orientation array")


def glyphs(source, shape, size, along=STATIC):
    """One glyph of a shape for each grain; size: its array, one number or three."""
    glyph = pv.Glyph(Input=source, GlyphType=shape, OrientationArray=along)
    glyph.ScaleArray = ["POINTS", size]
    glyph.VectorScaleMode = "Scale by Components"
    glyph.ScaleFactor = 1
    glyph.GlyphMode = "All Points"
    return glyph


def capsules(grains):
    """A cylinder along each shaft, and a sphere at both of its ends. ParaView's cylinder lies along y."""
    sized = pv.Calculator(Input=grains, ResultArrayName="size",
                          Function="length*iHat + diameter*jHat + diameter*kHat")
    shaft = glyphs(sized, "Cylinder", "size", ("POINTS", "axis"))
    shaft.GlyphType.Radius = 0.5
    shaft.GlyphType.Height = 1
    shaft.GlyphType.Resolution = 16
    shaft.GlyphTransform.Rotate = [0, 0, 90]
    ends = [pv.Calculator(Input=grains, ResultArrayName="end", CoordinateResults=1,
                          Function=f"coords {sign} 0.5*length*axis") for sign in "+-"]
    return [shaft] + [glyphs(end, "Sphere", "diameter") for end in ends]


def main(folder, picture, time=None):
    grains = pv.PVDReader(FileName=os.path.join(folder, "grains.pvd"))
    view = pv.CreateView("RenderView")
    view.ViewSize = [1000, 800]
    scene = pv.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = grains.TimestepValues[-1] if time is None else float(time)
    for part in capsules(grains):
        shown = pv.Show(part, view)
        pv.ColorBy(shown, ("POINTS", "velocity", "Magnitude"))
        shown.RescaleTransferFunctionToDataRange()
    walls = pv.Show(pv.PVDReader(FileName=os.path.join(folder, "walls.pvd")), view)
    walls.Opacity = 0.2
    view.CameraViewUp = [0, 0, 1]
    view.CameraPosition = [0.5, -1, 0.4]
    view.CameraFocalPoint = [0, 0, 0]
    pv.ResetCamera(view)
    pv.SaveScreenshot(picture, view)


main(*sys.argv[1:])
