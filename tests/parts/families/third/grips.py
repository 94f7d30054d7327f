"""Handles, grips and pulls shaped for the hand."""
import cadquery as cq

from ..register import part
from ..second.handles import swept_ellipses
from ..shapes import W, turned, less
from .sections import closed_curve, lofted, squarish, tilted


@part(turn=True, offset=1.0)
def file_handle():
    curve = W("XZ").moveTo(0, 0).lineTo(7, 0).lineTo(7, 10).lineTo(9, 10)
    curve = curve.spline([(12, 20), (10.5, 38), (14.5, 70), (11, 92), (0, 99)], tangents=[(0.6, 1), (-1, 0)], includeCurrent=True)
    body = curve.close().revolve(360, (0, 0, 0), (0, 1, 0))
    body = less(body, [W().box(40, 10, 50).translate((0, 16.5 * s, 66)).edges("|X").fillet(3) for s in (-1, 1)])
    body = body.cut(turned((0, -1), (2.5, -1), (2, 40), (0, 42))).cut(turned((6.3, 4), (8, 4), (8, 6), (6.3, 6)))
    return body.cut(W("YZ", origin=(0, 0, 90)).circle(2).extrude(30, both=True))


@part(turn=True)
def joystick_grip():
    rows = ((0, 0, 0.0, 17, 14), (1, 22, 0.08, 15, 12.5), (5, 48, 0.2, 17, 14), (13, 74, 0.32, 18, 15), (21, 94, 0.4, 15, 14))
    body = lofted([closed_curve(squarish(a, b, 2.5), tilted(x, z, angle)) for x, z, angle, a, b in rows])
    body = body.union(turned((0, -10), (20, -10), (21, -9), (21, -3), (19, 0.01), (0, 0.01)))
    top = W(tilted(21, 94, 0.4))
    body = body.union(top.workplane(offset=-1).circle(7).extrude(6)).union(W(tilted(21, 94, 0.4)).workplane(offset=5).sphere(5))
    body = body.cut(turned((0, -11), (7, -11), (7, 50), (0, 54))).cut(W("XZ", origin=(0, 0, -6)).circle(2).extrude(40, both=True))
    return body.cut(W("YZ", origin=(24, 0, 70)).slot2D(14, 8, 90).extrude(40))


@part(turn=True, offset=0.5)
def drawer_pull():
    path = cq.Edge.makeSpline([cq.Vector(-48, 0, 6), cq.Vector(-40, 0, 22), cq.Vector(0, 0, 32), cq.Vector(40, 0, 22), cq.Vector(48, 0, 6)],
                              tangents=[cq.Vector(0, 0, 1), cq.Vector(0, 0, -1)])
    body = swept_ellipses(path, ((0, 6, 6), (0.2, 6.5, 5), (0.5, 8.5, 4), (0.8, 6.5, 5), (1, 6, 6)))
    foot = lambda x: turned((0, 0), (10, 0), (10, 3), (8, 7), (0, 7)).translate((x, 0, 0))
    body = body.union(foot(-48)).union(foot(48))
    return less(body, [turned((0, -1), (2.2, -1), (2.2, 12), (0, 13.3)).translate((x, 0, 0)) for x in (-48, 48)])


@part(turn=True, offset=1.0)
def ladle():
    rim = turned((0, -30), (26, -30), (26, 0), (0, 0))
    bowl = W().sphere(22).cut(W().sphere(20)).intersect(rim)
    path = cq.Edge.makeSpline([cq.Vector(20.5, 0, -4), cq.Vector(38, 0, 14), cq.Vector(56, 0, 62), cq.Vector(82, 0, 100)],
                              tangents=[cq.Vector(1, 0, 0.3), cq.Vector(0.9, 0, 0.6)])
    body = swept_ellipses(path, ((0, 5.5, 2.6), (0.25, 4, 2.2), (0.6, 4.5, 2.2), (1, 8.5, 2.4))).cut(W().sphere(20.6))
    return bowl.union(body)


@part(turn=True, offset=1.0)
def trigger():
    outline = W("XZ", origin=(0, 5, 0)).moveTo(-8, 0).lineTo(-8, -6).lineTo(9, -6).spline([(7, -18), (11, -32), (19, -42)], includeCurrent=True).lineTo(15.5, -45)
    outline = outline.spline([(3, -34), (-1, -20), (-4, -12)], includeCurrent=True).lineTo(-16, -8).lineTo(-16, 0).close()
    body = outline.extrude(10).union(W("XZ", origin=(-4, 0, 0)).circle(8).extrude(6.5, both=True))
    body = body.cut(W("XZ", origin=(-4, 0, 0)).circle(3).extrude(20, both=True)).cut(W().box(12, 4, 16).translate((-16, 0, -4)))
    body = less(body, [W("XZ", origin=(x, y, z)).circle(2.6).extrude(-3 if y > 0 else 3) for x, z in ((4, -14), (5, -24)) for y in (-4, 4)])
    return body.cut(W("XY", origin=(7, 0, -10)).circle(1.2).extrude(12))
