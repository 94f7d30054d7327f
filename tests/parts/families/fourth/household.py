"""Things for the house and the hand, with spline faces."""
import math

import cadquery as cq

from ..register import part
from ..second.handles import swept_ellipses
from ..second.outlines import countersink
from ..shapes import W, disc, turned, less
from ..third.sections import closed_curve, lofted, squarish, tilted
from ..third.skins import under


@part(turn=True, offset=1.0)
def hand_bell():
    curve = W("XZ").moveTo(0, 52).lineTo(5, 52).spline([(15, 46), (19, 30), (23, 12), (33, 0)], tangents=[(1, 0), (1, -0.6)], includeCurrent=True)
    curve = curve.lineTo(31, -2).spline([(20.5, 11), (16.5, 29), (12.5, 43), (0, 48)], includeCurrent=True).close()
    body = curve.revolve(360, (0, 0, 0), (0, 1, 0)).union(turned((0, 51), (5, 51), (5, 58), (4, 59), (4, 66), (0, 66)))
    body = body.union(W("XZ", origin=(0, 0, 73)).circle(10).circle(7).extrude(3, both=True))
    clapper = turned((0, 14), (1.2, 14), (1.2, 50), (0, 50)).union(W().sphere(5).translate((0, 0, 13)))
    return body.union(clapper)


@part(turn=True)
def bishop():
    curve = W("XZ").moveTo(0, 4).lineTo(14, 4).spline([(13, 10), (7, 20), (4.6, 36), (6, 46)], tangents=[(0.4, 1), (0.5, 1)], includeCurrent=True)
    body = curve.lineTo(0, 46).close().revolve(360, (0, 0, 0), (0, 1, 0))
    head = W("XZ").moveTo(0, 48).lineTo(5, 48).spline([(8.4, 54), (7, 62), (2.2, 69.5)], includeCurrent=True).lineTo(0, 69.5).close().revolve(360, (0, 0, 0), (0, 1, 0))
    body = body.union(turned((0, 0), (16, 0), (17, 1), (17, 4), (0, 4))).union(turned((0, 45), (9, 45), (10, 46.5), (9, 48), (0, 48))).union(head)
    body = body.union(W().sphere(2.8).translate((0, 0, 71)))
    body = body.cut(W().box(16, 30, 1.6).rotate((0, 0, 0), (0, 1, 0), -40).translate((7.5, 0, 61)))
    return body.cut(turned((0, -1), (9, -1), (9, 2), (0, 4)))


@part(turn=True, offset=1.0)
def door_lever():
    body = turned((0, 0), (26, 0), (26, 6), (23, 9), (0, 9)).union(turned((0, 0), (9.5, 0), (9.5, 35), (11.5, 37), (11.5, 51), (10.5, 52), (0, 52)))
    path = cq.Edge.makeSpline([cq.Vector(2, 0, 44), cq.Vector(24, 0, 46), cq.Vector(62, 0, 38), cq.Vector(112, 0, 44)],
                              tangents=[cq.Vector(1, 0, 0.2), cq.Vector(1, 0, 0.35)])
    lever = swept_ellipses(path, ((0, 9, 6), (0.2, 8, 7), (0.55, 10, 4.6), (0.85, 9, 5.5), (1, 6, 4)))
    body = body.union(lever)
    body = body.cut(W("XY", origin=(0, 0, -1)).rect(8, 8).extrude(24).rotate((0, 0, 0), (0, 0, 1), 45))
    body = body.cut(W("XZ", origin=(0, 0, 24)).circle(2).extrude(20))
    return less(body, [countersink(2, 3.8, 20).translate((x, 0, 9)) for x in (-17.5, 17.5)])


@part(turn=True, offset=0.5)
def coffee_mug():
    curve = W("XZ").moveTo(0, 0).lineTo(27, 0).lineTo(29, 3).spline([(37, 20), (38, 44), (33, 66), (36, 84)], tangents=[(1, 1), (0.4, 1)], includeCurrent=True)
    curve = curve.lineTo(33, 84).spline([(30, 66), (34.6, 44), (33, 21), (20, 5.5), (0, 4.5)], tangents=[(-0.4, -1), (-1, 0)], includeCurrent=True).close()
    cup = curve.revolve(360, (0, 0, 0), (0, 1, 0))
    path = cq.Edge.makeSpline([cq.Vector(34, 0, 66), cq.Vector(56, 0, 66), cq.Vector(64, 0, 46), cq.Vector(36, 0, 22)],
                              tangents=[cq.Vector(1, 0, 0.3), cq.Vector(-1, 0, -0.6)])
    handle = swept_ellipses(path, ((0, 8, 4), (0.3, 6, 3.6), (0.6, 6.5, 3.6), (1, 7, 4)))
    void = W("XZ").moveTo(0, 90).lineTo(33, 90).lineTo(33, 84).spline([(31.5, 66), (36, 44), (34.2, 21), (20, 7)]).lineTo(0, 7).close().revolve(360, (0, 0, 0), (0, 1, 0))
    return cup.union(handle.cut(void)).cut(turned((0, -1), (23, -1), (22, 1.6), (0, 1.6)))


@part(turn=True)
def wrist_rest():
    height = lambda x, y: 15 + 4 * math.cos(x / 17) - 0.0022 * (y - 6) ** 2 - 0.05 * y + 0.0012 * x * x
    prism = W("XY").moveTo(-70, -26).lineTo(70, -26).lineTo(70, 14).threePointArc((0, 34), (-70, 14)).close().extrude(60).edges("|Z").fillet(11)
    body = under(height, prism, 84, 50)
    body = body.cut(W("XY", origin=(0, -1, -1)).rect(96, 26).extrude(7).edges("|Z").fillet(6))
    body = less(body, [turned((0, -0.01), (7, -0.01), (6.5, 1.5), (0, 1.5)).translate((x, y, 0)) for x in (-58, 58) for y in (-14, 6)])
    return body.cut(W("XZ", origin=(0, 0, 0)).circle(6).extrude(80, both=True).translate((0, 0, 1)).intersect(W().box(30, 40, 40).translate((0, 40, 0))))


@part(turn=True, offset=1.0)
def cabriole_leg():
    rows = ((0, 0, 0.1, 11, 11, 2), (10, 12, 0.55, 7.5, 7.5, 2.2), (15, 40, 0.1, 9, 9, 2.5), (10, 90, -0.15, 14, 14, 2.8), (-2, 140, -0.35, 21, 20, 3.2))
    leg = lofted([closed_curve(squarish(a, b, p), tilted(x, z, angle), 32) for x, z, angle, a, b, p in rows])
    block = W().box(42, 42, 44, centered=(True, True, False)).edges("|Z").chamfer(3).translate((-6, 0, 138))
    body = leg.union(block).union(turned((0, -9), (13, -9), (15, -7), (15, -3), (12, 0.5), (0, 0.5)))
    mortise = W().box(8, 26, 24).translate((-27, 0, 164))
    return body.cut(mortise).cut(W("XZ", origin=(-6, 0, 164)).rect(8, 22).extrude(40)).cut(disc(3, 20, -20))


@part(turn=True)
def iron_sole():
    side = W("XY").moveTo(-60, -38).lineTo(-60, 38).spline([(-20, 41), (30, 30), (74, 0)], tangents=[(1, 0.25), (0.55, -1)], includeCurrent=True)
    side = side.spline([(30, -30), (-20, -41), (-60, -38)], tangents=[(-0.55, -1), (-1, 0.25)], includeCurrent=True).close()
    body = side.extrude(14).cut(W("XY", origin=(-16, 0, 6)).rect(66, 46).extrude(20).edges("|Z").fillet(9))
    body = body.union(W("XY", origin=(-16, 0, 3)).slot2D(50, 16).extrude(9)).cut(W("XY", origin=(-16, 0, 7)).slot2D(42, 8).extrude(9))
    body = less(body, [disc(1.6, 30, -5, 10 + 9 * k, y * (3.7 - k)) for k in range(4) for y in (-7, 7)])
    body = less(body, [disc(2.4, 20, 5, x, y) for x, y in ((-52, -30), (-52, 30), (46, 0))])
    return body.cut(W("YZ", origin=(-70, 0, 10)).circle(3).extrude(16))


@part(turn=True, offset=0.5)
def side_mirror():
    rows = ((0, 46, 28, 3.2), (9, 48, 30, 3.0), (26, 41, 25, 2.6), (40, 26, 15, 2.3))
    shell = lambda thin, low: lofted([closed_curve(squarish(a - thin, b - thin, p), cq.Plane((0.12 * z * z / 10, 0, z - low)), 32) for z, a, b, p in rows])
    body = shell(0, 0).cut(W("XY", origin=(0, 0, -1)).slot2D(78, 42).extrude(5))
    body = body.cut(W("XY", origin=(0, 0, 3)).slot2D(62, 30).extrude(17))
    arm = W("XZ", origin=(-36, 0, 12)).circle(7).extrude(44).union(W("XZ", origin=(-36, -40, 12)).rect(24, 26).extrude(5).edges("|Y").fillet(4))
    body = body.union(arm.cut(W("XY", origin=(0, 0, -1)).slot2D(78, 42).extrude(21)))
    return less(body, [W("XZ", origin=(-36 + x, -30, 12 + z)).circle(1.6).extrude(30) for x, z in ((-8, -9), (8, -9), (0, 9.6))])


@part(turn=True, offset=1.0)
def hens_egg():
    curve = W("XZ").moveTo(0, 0).spline([(15, 6), (21.5, 22), (15.5, 45), (0, 57)], tangents=[(1, 0), (-1, 0)], includeCurrent=True).close()
    return curve.revolve(360, (0, 0, 0), (0, 1, 0))
