"""Bottles, vases, spouts: lofts and bodies of revolution of a spline."""
import math

import cadquery as cq

from ..register import part
from ..shapes import W, disc, turned, around, less, radial
from .sections import closed_curve, lofted, squarish, tilted


@part(turn=True, offset=1.0)
def wavy_vase():
    def body(thin, low):
        wave = lambda r, lobes, turn: lambda a: radial(r - thin + lobes * math.cos(5 * a + turn), a)
        rows = ((low, 24, 1.5, 0.0), (26, 32, 3.5, 0.3), (55, 27, 3.0, 0.7), (82, 19, 1.2, 1.0), (104, 25, 2.6, 1.3))
        return lofted([closed_curve(wave(r, lobes, turn), cq.Plane((0, 0, z)), 40) for z, r, lobes, turn in rows])
    return body(0, 0).cut(body(2.2, 3)).cut(turned((0, -1), (17, -1), (17, 1), (0, 1)))


@part(turn=True, offset=1.0)
def goblet():
    curve = W("XZ").moveTo(0, 0).lineTo(26, 0).lineTo(26, 1.5).spline([(12, 4), (4.5, 14), (4, 34), (14, 46), (26, 62), (24, 88)], includeCurrent=True)
    curve = curve.lineTo(22.4, 88).spline([(24.2, 63), (12, 48.5), (0, 45.5)], tangents=[(0.1, -1), (-1, 0)], includeCurrent=True).close()
    body = curve.revolve(360, (0, 0, 0), (0, 1, 0))
    return body.union(turned((0, 19), (5.5, 19), (7, 21), (7, 23), (5.5, 25), (0, 25))).cut(turned((0, -1), (18, -1), (16, 0.8), (0, 0.8)))


@part(turn=True, offset=1.0)
def pouring_spout():
    rows = ((0, 0, 0.0, 24, 24), (2, 22, 0.2, 19, 18), (12, 44, 0.65, 13, 11), (32, 60, 0.95, 9.5, 7), (52, 72, 1.0, 8.5, 5.5))
    solid = lambda thin: lofted([closed_curve(squarish(b - thin, a - thin, 2.3), tilted(x, z, angle)) for x, z, angle, a, b in rows])
    body = solid(0).union(turned((0, -12), (28, -12), (29, -11), (29, -5), (28, 0), (0, 0)))
    body = body.cut(solid(1.8)).cut(turned((0, -13), (26, -13), (24.5, -10), (24.5, -3), (22, -0.01), (22, 0.02), (0, 0.02)))
    return less(body, around(W("XY", origin=(0, 0, -13)).moveTo(30.2, 0).circle(2.5).extrude(9), 10))


@part(turn=True)
def pear_bulb():
    curve = W("XZ").moveTo(0, 0).lineTo(8, 0).lineTo(8, 2).lineTo(11, 4).lineTo(11, 20)
    curve = curve.spline([(13, 30), (23, 46), (25, 60), (16, 74), (0, 78.5)], tangents=[(0, 1), (-1, 0)], includeCurrent=True)
    body = curve.close().revolve(360, (0, 0, 0), (0, 1, 0))
    grooves = [turned((10.2, z), (11.1, z - 0.9), (12, z - 0.9), (12, z + 0.9), (11.1, z + 0.9)) for z in (7, 10, 13, 16)]
    return less(body, grooves).union(disc(4, 3, -2.4).faces("<Z").edges().fillet(1.2))


@part(turn=True, offset=0.5)
def soap_dish():
    rows = ((0, 40, 26, 2.2), (8, 47, 32, 2.5), (20, 51, 35, 2.8))
    outer = lofted([closed_curve(squarish(a, b, p), cq.Plane((0, 0, z)), 32) for z, a, b, p in rows])
    inner = lofted([closed_curve(squarish(a, b, p), cq.Plane((0, 0, z)), 32) for z, a, b, p in ((4, 34, 20, 2.2), (11, 43, 28, 2.5), (20.01, 48, 32, 2.8))])
    body = outer.cut(inner)
    ribs = [W("YZ", origin=(x, 0, 3)).polyline([(-18, 0), (18, 0), (16, 3.5), (-16, 3.5)]).close().extrude(2) for x in (-22, -12, -2, 8, 18)]
    for rib in ribs:
        body = body.union(rib)
    return less(body, [W("XY", origin=(x + 6, 0, -5)).slot2D(16, 3.4, 90).extrude(30) for x in (-22, -12, -2, 8)])
