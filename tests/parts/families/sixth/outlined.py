"""Plates, rings and cams bounded by splines."""
import math

import cadquery as cq
import numpy as np

from ..register import part
from ..second.outlines import counterbore, countersink, lying
from ..shapes import W, disc, turned, around, less, radial
from ..third.sections import closed_curve


def prism(wire, h):
    """What lies over a closed wire, up by h."""
    return W(obj=cq.Solid.extrudeLinear(wire, [], cq.Vector(0, 0, h)))


@part(turn=True, offset=1.0)
def dropout():
    curve = W().moveTo(-34, 26).spline([(-14, 16), (4, 19), (20, 12)], tangents=[(1, -0.8), (0.7, -1)], includeCurrent=True).lineTo(20, -12)
    curve = curve.spline([(6, -18), (-12, -12), (-40, -14)], tangents=[(-1, -0.4), (-1, -0.3)], includeCurrent=True).lineTo(-40, -4)
    body = curve.spline([(-24, 2), (-24, 10), (-41, 19)], includeCurrent=True).close().extrude(7).union(disc(9, 10, -1.5))
    body = body.cut(W("XY", origin=(10, 0, -5)).rect(20, 10).extrude(20)).cut(disc(5, 20, -5))
    body = body.union(W("XY", origin=(3, -20, 0)).circle(6.5).extrude(7)).cut(disc(4.2, 20, -5, 3, -20)).cut(W("XY", origin=(-16, -3.5, -1)).slot2D(13, 6).extrude(20))
    return body.cut(countersink(1.5, 2.8, 20).translate((-14, 11, 7))).cut(lying(disc(1.4, 40), "-x").translate((-50, -9, 3.5)))


@part(turn=True, offset=0.5, scale=2)
def guitar_body():
    def edge(a):
        r = 62 + 14 * math.cos(2 * a) + 5 * math.cos(3 * a + 0.3) - 4 * math.cos(a) - 4 * math.sin(a)
        return r * math.cos(a) * 1.15, r * math.sin(a)
    body = prism(closed_curve(edge, count=32), 20)
    body = body.cut(disc(22, 60, -5, 82, 30)).cut(W("XY", origin=(44, 0, 12)).rect(44, 28).extrude(20).edges("|Z").fillet(4))
    body = less(body, [W("XY", origin=(x, 0, 10)).rect(16, 40).extrude(20).edges("|Z").fillet(3) for x in (8, -22)])
    cavity = W("XY", origin=(-46, -24, -1)).slot2D(44, 18, 20).extrude(15)
    body = body.cut(cavity).cut(W("XY", origin=(-46, -24, -1)).slot2D(50, 24, 20).extrude(2.5))
    body = less(body, [disc(2, 40, -5, *spot) for spot in ((-54, -26), (-38, -21))] + [disc(2.4, 40, -5, -44, y) for y in (-2, 6, 14)])
    return body.cut(lying(disc(3.4, 40), "-x").translate((-90, -24, 10)))


@part(turn=True, offset=1.0)
def bell_cam():
    lift = lambda a: 26 + 6 * math.cos(2 * a) + 2.5 * math.sin(a)

    def rim(r):
        points = [cq.Vector(*radial(r, a), lift(a)) for a in np.arange(24) * 2 * math.pi / 24]
        return cq.Edge.makeSpline(points, periodic=True, parameters=range(25))
    ring = W(obj=max(disc(26, 50).cut(disc(19, 80, -5)).val().split(cq.Face.makeRuledSurface(rim(17), rim(28))).Solids(), key=lambda s: -s.Center().z))
    body = ring.union(turned((0, 0), (20, 0), (20, 10), (0, 10))).union(turned((0, -14), (12, -14), (13, -13), (13, 1), (0, 1)))
    body = body.cut(disc(7, 60, -20)).cut(W().box(4, 18, 60)).cut(lying(disc(2, 40), "+x").translate((20, 0, -7)))
    return less(body, around(counterbore(1.7, 3, 2, 20).translate((15, 0, 10)), 4))
