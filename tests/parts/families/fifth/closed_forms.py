"""Forms of one free face, closed."""
import math

import cadquery as cq

from ..register import part
from ..shapes import W, radial
from ..third.sections import closed_curve

@part(turn=True, offset=2.0)
def pebble():
    curve = W("XZ").moveTo(0, -13).spline([(21, -8), (29, 3), (17, 13), (0, 15)], tangents=[(1, 0), (-1, 0)], includeCurrent=True).close()
    egg = curve.revolve(360, (0, 0, 0), (0, 1, 0))
    return W(obj=egg.val().transformGeometry(cq.Matrix([[1, 0, 0.2, 0], [0, 0.68, 0.1, 0], [0, 0, 1, 0]])))


@part(uniform=False, turn=True, offset=1.0)  # gmsh takes minutes over a face closed both ways
def quad_ring():
    def section(a):
        x, y = radial(2.6 + 0.55 * math.cos(4 * a), a + math.pi / 4)
        return 22 + x, y
    return W(obj=cq.Solid.revolve(closed_curve(section, cq.Plane.XZ()), [], 360, cq.Vector(0, 0, 0), cq.Vector(0, 0, 1)))
