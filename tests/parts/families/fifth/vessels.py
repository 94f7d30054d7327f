"""Vessels of sheet, of pottery and blown."""
import cadquery as cq

from ..register import part
from ..second.handles import swept_ellipses
from ..second.outlines import lying, rounded_rect
from ..shapes import W, disc, turned, around, joined, less
from ..third.sections import closed_curve, lofted, squarish, tilted
from .profiles import round_body


@part(turn=True, offset=1.0, scale=8)
def cyclone_separator():
    duct = lambda grow: W().box(52, 11 + grow, 24 + grow).translate((-26, 17, 74))
    body = turned((0, 0), (9, 0), (25, 52), (25, 90), (0, 90)).union(duct(3)).union(disc(28, 3, 88)).union(disc(17, 3))
    body = body.union(W().box(3, 26, 40).translate((-51, 17, 74)))
    body = body.cut(turned((0, -1), (7.5, -1), (7.5, 4), (23.5, 52), (23.5, 88), (0, 88))).cut(duct(0).translate((-1, 0, 0)))
    body = body.union(disc(12, 48, 62)).union(turned((11, 104), (18, 104), (18, 107), (11, 107)))
    body = less(body, around(disc(1.5, 9, -5, 13.4), 6)).cut(disc(10.5, 80, 50))
    return less(body, [W("YZ", origin=(-60, 17 + y, 74 + z)).circle(1.3).extrude(12) for y in (-10.4, 10.4) for z in (-17, 17)])


@part(turn=True, offset=1.0, scale=2)
def saucepan():
    body = round_body((0, 0), (40, 0, 8), (42, 42), (45, 43.4), (45, 44.6), (40.2, 44.6), (38.2, 2.4, 6), (0, 2.4))
    handle = turned((0, 0), (3.4, 0), (5.6, 24), (4.8, 70), (0, 70)).union(W().sphere(5).translate((0, 0, 70)))
    handle = lying(handle, "+x").rotate((0, 0, 0), (0, 1, 0), -9).translate((50, 0, 33))
    shank = W("XZ").polyline([(40, 26), (44, 28), (56, 30), (56, 37), (44, 37), (40, 36)]).close().extrude(4, both=True)
    body = body.union(handle.union(shank).cut(disc(41, 80, -10)))
    return body.cut(W("XY", origin=(114, 0, 0)).slot2D(9, 4).extrude(80)).cut(turned((12, -0.01), (31, -0.01), (31, 0.5), (12, 0.5)))


@part(turn=True, offset=0.5, scale=5)
def hopper():
    funnel = lambda w, z, h: W("XY", origin=(0, 0, z)).rect(w, w * 0.8).extrude(-h, taper=20)
    body = funnel(80, 58.01, 58).union(W().box(80, 64, 12).translate((0, 0, 64))).union(rounded_rect(96, 80, 5, 3).translate((0, 0, 67)))
    body = body.union(W().box(54, 40, 4, centered=(True, True, False)))
    body = body.cut(funnel(76, 58.01, 70)).cut(W().box(76, 60.8, 40).translate((0, 0, 78)))
    angle = lambda x, y: W().box(6, 6, 92, centered=(True, True, False)).translate((x, y, -24)).cut(W().box(4, 4, 200).translate((x * 0.96, y * 0.955, 0)))
    body = joined(body, [angle(x, y) for x in (-43, 43) for y in (-35, 35)])
    window = W("YZ", origin=(0, 0, 34)).circle(4).extrude(60)
    return less(body.cut(window), [disc(1.8, 20, 60, x, y) for x in (-20, 0, 20) for y in (-36, 36)])


@part(turn=True, offset=1.0)
def detergent_jug():
    rows = ((0, 0, 36, 22, 3.2), (22, 0, 39, 25, 3.4), (62, -1, 38, 24, 3.0), (92, -6, 30, 19, 2.6), (112, -12, 15, 14, 2.2))
    body = lofted([closed_curve(squarish(a, b, p), cq.Plane((x, 0, z)), 36) for z, x, a, b, p in rows])
    body = body.union(turned((0, 109), (12, 109), (12, 126), (0, 126)).translate((-12, 0, 0)))
    body = joined(body, [turned((11, z), (13.4, z + 0.8), (13.4, z + 1.4), (11, z + 2.2)).translate((-12, 0, 0)) for z in (116, 121)])
    body = body.cut(turned((0, 100), (9.6, 100), (9.6, 130), (0, 130)).translate((-12, 0, 0)))
    body = body.cut(W("XZ", origin=(15, 0, 66)).slot2D(38, 13, 100).extrude(60, both=True)).cut(rounded_rect(52, 28, 8, 2))
    return body.cut(rounded_rect(40, 50, 6, 3).rotate((0, 0, 0), (1, 0, 0), 90).translate((-10, -22.6, 34)))


@part(turn=True, offset=1.0)
def teapot():
    curve = W("XZ").moveTo(0, 0).lineTo(24, 0).lineTo(24, 2).spline([(37, 16), (41, 34), (33, 54), (18, 66)], includeCurrent=True).lineTo(18, 69).lineTo(0, 69)
    body = curve.close().revolve(360, (0, 0, 0), (0, 1, 0))
    rows = ((33, 24, 1.1, 13, 12), (50, 33, 0.95, 9, 9), (62, 49, 0.6, 6.5, 7), (74, 66, 0.9, 5.5, 6))
    spout = lofted([closed_curve(squarish(a, b, 2.2), tilted(x, z, angle)) for x, z, angle, a, b in rows])
    path = cq.Edge.makeSpline([cq.Vector(-32, 0, 52), cq.Vector(-56, 0, 60), cq.Vector(-64, 0, 36), cq.Vector(-37, 0, 18)],
                              tangents=[cq.Vector(-1, 0, 0.6), cq.Vector(1, 0, -0.3)])
    handle = swept_ellipses(path, ((0, 6, 4), (0.3, 5, 3.4), (0.6, 5, 3.2), (1, 5.5, 4)))
    body = body.union(spout).union(handle).union(turned((0, 69), (21, 69), (21, 71), (8, 76), (0, 76))).union(disc(3, 8, 74)).union(W().sphere(6).translate((0, 0, 84)))
    return body.cut(turned((0, -1), (20, -1), (19, 1.4), (0, 1.4))).cut(disc(1, 30, 60, 12, 0))
