"""What hands hold: a wheel, knobs, levers, a hook."""
import math

import cadquery as cq
import numpy as np
from OCP.BRepOffsetAPI import BRepOffsetAPI_ThruSections

from ..register import part
from ..shapes import W, disc, turned, around, joined, less
from .outlines import inside


@part(turn=True, offset=1.0)
def handwheel():
    rim = W("XZ").moveTo(46, 13).lineTo(52, 13).threePointArc((59, 20), (52, 27)).lineTo(46, 27).close().revolve(360, (0, 0, 0), (0, 1, 0))
    rim = rim.edges(cq.selectors.RadiusNthSelector(1)).fillet(2)
    hub = turned((0, 0), (14, 0), (14, 4), (12, 18), (0, 18)).edges("%CIRCLE").edges(">Z").fillet(2)
    spoke = W("YZ").circle(4.5).extrude(50).rotate((0, 0, 0), (0, 1, 0), -14).translate((0, 0, 8)).rotate((0, 0, 0), (0, 0, 1), 25)
    body = joined(rim, around(spoke, 5)).union(hub)
    body = body.union(disc(6, 12, 18, 52)).cut(disc(3, 40, 10, 52)).cut(disc(6, 60, -10)).cut(W().box(4, 15.6, 60))
    return body.edges("%CIRCLE").edges(">Z").chamfer(0.8)


@part(turn=True)
def fluted_knob():
    R = (19 ** 2 + 6.5 ** 2) / 13  # of the dome, centred on the axis
    curve = W("XZ").moveTo(0, 0).lineTo(18, 0).lineTo(20, 2).spline([(21, 8), (17, 17), (19, 24)], includeCurrent=True)
    body = curve.threePointArc((10, 30.5 - R + math.sqrt(R * R - 100)), (0, 30.5)).close().revolve(360, (0, 0, 0), (0, 1, 0))
    body = less(body, around(disc(5, 60, 4, 21), 7))
    body = body.union(turned((0, -10), (9, -10), (10, -9), (10, 1), (0, 1)))
    return body.cut(turned((0, -11), (4, -11), (4, 12), (0, 14))).cut(W("YZ", origin=(0, 0, -5)).circle(1.6).extrude(20))


def swept_ellipses(curve, sections):
    """A loft of ellipses across a curve in the plane of x and z: where on it, half axes along y and in the plane."""
    tool = BRepOffsetAPI_ThruSections(True, False)
    tool.CheckCompatibility(False)  # the check cuts the loft in two
    for t, a, b in sections:
        plane = cq.Plane(curve.positionAt(t), (0, 1, 0), curve.tangentAt(t))
        tool.AddWire(W(plane).ellipse(a, b).val().wrapped)
    return W(obj=cq.Shape.cast(tool.Shape()))


@part(turn=True, offset=1.0)
def crane_hook():
    spine = [(0, 0, 50), (4, 0, 35), (17, 0, 19), (25, 0, 0), (18, 0, -20), (0, 0, -28), (-18, 0, -20), (-25, 0, -4)]
    curve = cq.Edge.makeSpline([cq.Vector(*q) for q in spine])
    sizes = [(6, 6.5), (6.5, 7.5), (8, 9.5), (9.5, 12), (9.5, 12.5), (8.5, 10.5), (6, 7), (3, 3.6)]
    body = swept_ellipses(curve, [(t, a, b) for t, (a, b) in zip(np.linspace(0, 1, len(sizes)), sizes)])
    shank = turned((0, 44), (10, 44), (11, 45), (11, 51), (8, 55), (8, 60), (12, 62), (12, 66), (9, 66), (9, 84), (8, 85), (0, 85))
    return body.union(shank).cut(W("YZ", origin=(0, 0, 77)).circle(2).extrude(40, both=True))


@part(turn=True, offset=1.0)
def lever_handle():
    path = cq.Edge.makeSpline([cq.Vector(0, 0, 26), cq.Vector(22, 0, 38), cq.Vector(60, 0, 36), cq.Vector(105, 0, 42)],
                              tangents=[cq.Vector(0.2, 0, 1), cq.Vector(1, 0, 0.4)])
    body = swept_ellipses(path, ((0, 7, 7), (0.2, 7, 6), (0.45, 9, 5), (0.75, 9.5, 5), (1, 7, 4)))
    body = body.union(turned((0, 0), (24, 0), (24, 5), (22, 8), (10, 8), (10, 30), (0, 30)).edges("%CIRCLE").edges(inside((-1, -1, 7), (1, 1, 9))).fillet(1))
    body = body.cut(W().rect(8, 8).extrude(18, both=True)).cut(W("YZ", origin=(0, 0, 14)).circle(2).extrude(-30))
    return body.cut(disc(2, 40, -10, -17, 0))


@part(turn=True)
def pistol_grip():
    rings = []
    for z, x, a, b in ((0, 0, 17, 11), (18, 1.5, 15, 11.5), (34, 5, 16.5, 12), (50, 8, 14.5, 11), (68, 14, 17, 11), (84, 19, 16, 10)):
        rings.append(W("XY", origin=(x, 0, z)).ellipse(a, b).val())
    body = W(obj=cq.Solid.makeLoft(rings, False)).union(W("XY", origin=(0, 0, -6)).ellipse(20, 14).extrude(6))
    body = body.union(W().box(60, 22, 12).edges("|X").fillet(4).translate((14, 0, 90)))
    body = body.cut(W("XZ", origin=(-14, 0, 90)).circle(3).extrude(40, both=True)).cut(W("YZ", origin=(-40, 0, 90)).circle(2.5).extrude(60))
    return body.cut(turned((0, -10), (5, -10), (5, 40), (0, 43)))
