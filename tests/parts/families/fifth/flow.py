"""What wind, water and sound flow along."""
import math

import cadquery as cq
import numpy as np

from ..register import part
from ..second.outlines import lying, rounded_rect
from ..shapes import W, disc, turned, around, joined, less
from ..third.sections import closed_curve, foil, lofted, squarish


@part(uniform=False, turn=True, offset=1.0)  # gmsh makes 360,000 triangles of the blade
def wind_blade():
    rows = ((0, 15, 0.85, 0.0, 0.5), (24, 22, 0.42, 0.03, 0.42), (60, 21, 0.26, 0.06, 0.26), (115, 17, 0.24, 0.05, 0.14), (172, 11, 0.24, 0.04, 0.06))
    body = lofted([foil(chord, thick, camber, angle, -0.1 * chord, 0, z) for z, chord, thick, camber, angle in rows])
    body = body.union(turned((0, -12), (12, -12), (12, -8), (9, -8), (9, 0.4), (0, 0.4)))
    body = less(body, around(disc(1.2, 10, -14, 10.4), 8))
    return body.cut(turned((0, -13), (5, -13), (5, -2), (0, 0))).cut(disc(0.8, 200, -20, 0, 0).intersect(W().box(9, 9, 30).translate((0, 0, -12))))


@part(turn=True)
def pelton_bucket():
    def bowl(grow, y):
        a, b = 24 + grow, 13 + grow
        curve = W("XZ").moveTo(0, -a).spline([(b * math.sin(t), -a * math.cos(t)) for t in np.linspace(0, math.pi, 9)[1:]], tangents=[(1, 0), (-1, 0)], includeCurrent=True)
        return lying(curve.close().revolve(360, (0, 0, 0), (0, 1, 0)), "+x").translate((0, y, 0))
    body = joined(bowl(2.4, -14), [bowl(2.4, 14)]).cut(W().box(200, 200, 60).translate((0, 0, 28.5)))
    shank = W().box(36, 16, 20.5, centered=(False, True, False)).translate((-60, 0, -22)).edges("|Z").edges("<X").fillet(5)
    body = less(body.union(shank), [bowl(0, y) for y in (-14, 14)])
    body = body.cut(W("XY", origin=(27, 0, -40)).slot2D(22, 13).extrude(60))
    body = less(body, [W("XZ", origin=(x, 0, -11)).circle(3.2).extrude(40, both=True) for x in (-53, -40)])
    return body.cut(W().box(26, 4, 60).translate((-58, 0, 0)))


@part(turn=True, offset=0.5)
def horn_speaker():
    rows = ((0, 9, 9, 2.0), (18, 12, 11, 2.2), (42, 24, 18, 2.8), (66, 47, 31, 4.5))
    horn = lambda grow, low: lofted([closed_curve(squarish(a + grow, b + grow, p), cq.Plane((0, 0, z - low)), 40) for z, a, b, p in rows])
    body = horn(2.2, 0).union(rounded_rect(112, 80, 9, 5).translate((0, 0, 61)))
    body = body.union(turned((0, -20), (26, -20), (27, -19), (27, -3), (24, 0.4), (0, 0.4)))
    body = body.cut(horn(0, 0)).cut(disc(8, 30, -12))
    bracket = [W().box(14, 6, 14).translate((0, y, -10)) for y in (-29, 29)]
    body = joined(body, bracket).cut(W("XZ", origin=(0, 0, -10)).circle(2.2).extrude(33, both=True).cut(disc(27.5, 60, -40)))
    return less(body, [disc(2.2, 20, 55, x, y) for x in (-50, 50) for y in (-34, 34)])
