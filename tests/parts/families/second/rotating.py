"""Wheels, pulleys, bearing parts, a collet and a valve."""
import math

import cadquery as cq

from ..register import part
from ..shapes import W, disc, turned, around, less, radial
from .outlines import countersink, inside, lying


@part(turn=True, offset=1.0)
def timing_pulley():
    body = less(disc(20, 16), around(disc(1.9, 40, -10, 19.6), 24)).edges("|Z").fillet(0.4)
    rim = turned((0, -1.5), (22.5, -1.5), (21, 0), (0, 0))
    body = body.union(rim).union(rim.rotate((0, 0, 0), (1, 0, 0), 180).translate((0, 0, 16))).union(disc(13, 10, 16)).cut(disc(5, 60, -20))
    body = body.faces(">Z").edges().chamfer(0.8)
    return less(body, [W("YZ", origin=(0, 0, 22)).circle(2).extrude(30), W("XZ", origin=(0, 0, 22)).circle(2).extrude(30)])


@part(turn=True, offset=0.5, scale=3)
def rope_sheave():
    k = 5 * math.sqrt(0.5)
    groove = W("XZ").moveTo(40 - k, -k).threePointArc((35, 0), (40 - k, k)).lineTo(48, 8 + k).lineTo(48, -8 - k).close().revolve(360, (0, 0, 0), (0, 1, 0))
    body = turned((11, -11), (18, -11), (18, -4), (31, -4), (33, -8), (45, -8), (45, 8), (33, 8), (31, 4), (18, 4), (18, 11), (11, 11)).cut(groove)
    body = body.edges("%CIRCLE").edges(inside((-0.1, -0.1, -4.1), (0.1, 0.1, 4.1))).fillet(1.5)
    hole = W().moveTo(21.5, -3).lineTo(28, -5).lineTo(28, 5).lineTo(21.5, 3).close().extrude(20, both=True).edges("|Z").fillet(2)
    body = less(body, around(hole, 6)).faces("<Z or >Z").edges().chamfer(0.7)
    body = body.cut(turned((0, -3), (12, -3), (12, 3), (0, 3))).cut(W().box(4, 13, 60).translate((0, 6.5, 0)))
    return body.cut(lying(turned((0, -40), (1.5, -40), (1.5, 0), (0, 0)), "-x").translate((-20, 0, 0)).cut(disc(60, 40, 4)))


@part(turn=True)
def ball_cage():
    body = turned((24, -5), (25, -6), (27, -6), (27, -5.4), (29.5, -5.4), (30, -5), (30, 5), (29.5, 5.4), (27, 5.4), (27, 6), (25, 6), (24, 5))
    body = less(body, around(W().sphere(4.2).translate((27, 0, 0)), 9))
    body = less(body, around(disc(1, 40, -20, 27).rotate((0, 0, 0), (0, 0, 1), 20), 9))
    return less(body, around(W().box(10, 3, 3).edges("|X").fillet(1).translate((27, 0, 6.5)).rotate((0, 0, 0), (0, 0, 1), 20), 3, 120))


@part(turn=True, offset=1.0)
def thrust_plate():
    body = disc(40, 8).faces(">Z or <Z").edges().chamfer(0.8).cut(disc(15, 40, -10)).cut(W(obj=cq.Solid.makeTorus(30, 4.2)).translate((0, 0, 10)))
    body = body.cut(W().box(100, 100, 40).translate((88, 0, 0))).cut(W().box(100, 100, 40).translate((-88, 0, 0)))
    groove = W("YZ", origin=(14, 0, 8.8)).circle(2).extrude(40)
    body = less(body, [groove.rotate((0, 0, 0), (0, 0, 1), a) for a in (90, 210, 330)])
    holes = [countersink(1.8, 3.4, 20).rotate((0, 0, 0), (0, 1, 0), 180).translate((21 * math.cos(a), 21 * math.sin(a), 0)) for a in (0.3, 2.4, 4.5)]
    return less(body, holes).cut(turned((19, -0.01), (24.3, -0.01), (24.3, 1.2), (19, 1.2)).intersect(W().box(9, 100, 10)))


@part(turn=True, offset=1.0, scale=0.3)
def collet():
    body = turned((0, 0), (12, 0), (13, 1), (13, 28), (12, 29), (12, 33), (18, 50), (18, 53), (17, 54), (0, 54))
    body = body.cut(turned((0, -1), (9, -1), (9, 30), (6, 34), (6, 52.5), (7.5, 54.01), (0, 54.01)))
    slit = W().box(40, 1.6, 30, centered=(False, True, False)).translate((0, 0, 26)).union(W("YZ", origin=(0, 0, 26)).circle(1.6).extrude(40))
    body = less(body, around(slit, 3))
    grooves = [turned((11.9, z), (13.1, z - 0.8), (14, z - 0.8), (14, z + 0.8), (13.1, z + 0.8)) for z in (3.2, 5.4, 7.6, 9.8, 12)]
    return less(body, grooves).cut(W().box(6, 3, 10).translate((-13.5, 0, 21)).edges("|X").fillet(1.4))


@part(turn=True)
def poppet_valve():
    R = (12 ** 2 + 1.7 ** 2) / 3.4  # of the dish, centred on the axis
    profile = W("XZ").moveTo(0, -60).lineTo(3.2, -60).lineTo(4, -59).lineTo(4, -57).threePointArc((3.2, -56.2), (4, -55.4)).lineTo(4, -14)
    profile = profile.threePointArc((4 + 12 * (1 - math.sqrt(0.5)), -14 + 12 * math.sqrt(0.5)), (16, -2)).lineTo(18, -2).lineTo(20, 0).lineTo(20, 2).lineTo(12, 2)
    body = profile.threePointArc((6, 0.3 + R - math.sqrt(R * R - 36)), (0, 0.3)).close().revolve(360, (0, 0, 0), (0, 1, 0))
    return body.cut(W().box(14, 1.4, 4).translate((0, 0, 2)))


@part(offset=0.5)
def geneva_wheel():
    body = disc(40, 6)
    slots = around(W().moveTo(34, 0).slot2D(40, 5).extrude(20, both=True), 6)
    rests = around(disc(17, 40, -10, 46).rotate((0, 0, 0), (0, 0, 1), 30), 6)
    body = less(body, slots + rests).faces(">Z or <Z").edges().chamfer(0.5)
    body = body.union(turned((0, -5), (10, -5), (10, 6), (12, 6), (9, 12), (0, 12))).cut(disc(4, 40, -10))
    body = less(body, around(disc(1.5, 40, -10, 7).rotate((0, 0, 0), (0, 0, 1), 30), 3))
    return body.cut(W("XZ", origin=(0, 0, 9)).circle(1.2).extrude(30))


@part(turn=True, offset=2.0)
def ratchet_wheel():
    n, points = 20, []
    for k in range(n):
        a = 2 * math.pi * k / n
        points += [radial(30, a), radial(25.5, a + 0.03)]
    body = W().polyline(points).close().extrude(8).intersect(disc(29.4, 8))
    body = body.union(turned((0, -4), (12, -4), (12, 0), (12, 15), (11, 16), (0, 16))).edges(inside((-0.1, -0.1, 7.9), (0.1, 0.1, 8.1))).fillet(2)
    body = body.cut(W("XY", origin=(0, 0, -10)).rect(11, 11).extrude(40).edges("|Z").fillet(1))
    window = W().moveTo(18.5, 0).circle(3.2).extrude(40, both=True)
    body = less(body, around(window, 5))
    return body.cut(W("YZ", origin=(0, 0, 12)).circle(1.5).extrude(40))


@part(turn=True, offset=1.0)
def rod_end():
    body = W().sphere(20).intersect(W().box(60, 60, 17)).union(W("YZ").circle(7).extrude(52))
    body = body.edges(inside((18, -8, -8), (19.5, 8, 8))).fillet(2).faces(">X").edges().chamfer(1)
    body = body.cut(disc(9.5, 40, -20)).cut(W().sphere(12.5)).cut(W().box(3, 60, 20).translate((34, 36, 0))).cut(W().box(3, 60, 20).translate((34, -36, 0)))
    return less(body, [lying(turned((6.2, -x), (7.2, -x - 0.8), (8, -x - 0.8), (8, -x + 0.8), (7.2, -x + 0.8)), "-x") for x in (40, 42, 44, 46, 48)])
