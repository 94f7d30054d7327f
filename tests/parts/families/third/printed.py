"""Printed parts: clips, knobs, covers, guards."""
import math

from ..register import part
from ..second.outlines import countersink, inside, lying, nearest, rounded_rect
from ..shapes import W, disc, turned, around, joined, less


@part(turn=True, offset=1.0)
def snap_clip():
    a = math.radians(42)
    tip = lambda r, s: (s * r * math.sin(a), 14 + r * math.cos(a))
    ring = W("XZ", origin=(0, 0, 14)).circle(10.5).extrude(7, both=True)
    body = ring.union(W().box(34, 14, 4, centered=(True, True, False))).union(W().box(12, 14, 8, centered=(True, True, False)))
    body = body.edges("|Y").edges(inside((-7, -1, 3), (7, 1, 5))).fillet(1.2)
    body = body.cut(W("XZ", origin=(0, 0, 14)).circle(8).extrude(20, both=True))
    body = body.cut(W("XZ").polyline([(0, 14), tip(20, 1), tip(20, -1)]).close().extrude(20, both=True))
    lips = [W("XZ", origin=(tip(9.25, s)[0], 0, tip(9.25, s)[1])).circle(1.9).extrude(7, both=True) for s in (-1, 1)]
    body = joined(body, lips).edges("|Z").edges("<X or >X").fillet(3)
    return less(body, [countersink(1.7, 3.2, 10).translate((x, 0, 4)) for x in (-13, 13)])


@part(turn=True)
def pointer_knob():
    body = turned((0, 0), (15, 0), (16, 1), (16, 5), (0, 5)).union(W("XY", origin=(0, 0, 4)).circle(11).extrude(14, taper=5).faces(">Z").edges().fillet(1.5))
    wedge = W().moveTo(-11, -4).lineTo(14, -1.4).threePointArc((15.5, 0), (14, 1.4)).lineTo(-11, 4).threePointArc((-13, 0), (-11, -4)).close().extrude(20)
    body = body.union(wedge.faces(">Z").edges().chamfer(1))
    body = body.cut(disc(12, 3, -0.01)).union(disc(6, 5))
    body = body.cut(disc(3, 12, -1).cut(W().box(8, 3, 14).translate((0, 4, 6))))
    body = less(body, around(W().box(1.2, 2, 10).translate((15.9, 0, 3)), 24))
    return body.cut(W().box(8, 1, 2).translate((9, 0, 20)))


@part(turn=True)
def finger_guard():
    rings = [turned((r, 0), (r + 1.6, 0), (r + 1.6, 2.2), (r, 2.2)).faces(">Z").edges().fillet(0.5) for r in (9, 15, 21, 27)]
    body = joined(disc(5, 2.2).faces(">Z").edges().fillet(0.8), rings)
    spokes = [W().box(29, 2, 1.6, centered=(False, True, False)).rotate((0, 0, 0), (0, 0, 1), 45 + 90 * k) for k in range(4)]
    lugs = [disc(4, 3, 0, 28.5).rotate((0, 0, 0), (0, 0, 1), 45 + 90 * k) for k in range(4)]
    body = joined(body, spokes + lugs)
    return less(body, [countersink(1.6, 2.9, 8).translate((28.5, 0, 3)).rotate((0, 0, 0), (0, 0, 1), 45 + 90 * k) for k in range(4)])


@part(turn=True, offset=0.5)
def belt_anchor():
    body = W().box(26, 16, 14, centered=(True, True, False)).edges("|Z").fillet(2).faces(">Z").edges().chamfer(0.6)
    body = body.cut(W().box(40, 1.4, 9).translate((0, 0, 11.5)))
    teeth = [disc(0.6, 9, 7, -12 + 2 * k, 0.8) for k in range(13)]
    body = less(body, teeth)
    body = body.union(W().box(42, 16, 3, centered=(True, True, False)).edges("|Z").fillet(5))
    body = less(body, [disc(1.7, 10, -1, x) for x in (-17, 17)])
    nut = W("XZ", origin=(0, -8, 4)).polygon(6, 6.2).extrude(-2.6)
    return body.cut(nut).cut(W("XZ", origin=(0, 0, 4)).circle(1.6).extrude(20, both=True))


@part(turn=True, offset=1.0)
def coat_hook():
    plate = W("XZ").rect(26, 60).extrude(5).edges("|Y").fillet(10).faces("<Y").edges().chamfer(0.8)
    path = W("YZ").moveTo(-2, -8).lineTo(-16, -8).threePointArc((-16 - 10 * math.sqrt(0.5), -8 + 10 * (1 - math.sqrt(0.5))), (-26, 2)).lineTo(-26, 14)
    arm = W("XZ", origin=(0, -2, -8)).circle(5).sweep(path)
    body = plate.union(arm).union(W().sphere(7).translate((0, -26, 18)))
    body = body.edges("%CIRCLE").edges(inside((-6, -5.2, -14), (6, -4.8, -2))).fillet(2.5)
    return less(body, [lying(countersink(2, 4, 10), "-y").translate((0, -5, z)) for z in (18, -22)])


@part(turn=True)
def battery_door():
    body = W().box(48, 30, 2, centered=(True, True, False)).edges("|Z").fillet(3).faces(">Z").edges().chamfer(0.5)
    body = body.union(rounded_rect(43, 25, 2, -3).cut(rounded_rect(40, 22, 1, -3)))
    tongue = W("XZ").polyline([(18, 0), (18, -7), (21.5, -7), (23, -5.2), (21.3, -4.2), (20, -4.2), (20, 0)]).close().extrude(5, both=True)
    body = body.union(tongue).edges("|Y").edges(nearest((20, 0, 0))).fillet(0.6)
    tab = W("XZ").moveTo(-20, 1).lineTo(-26, 1).threePointArc((-27, 0), (-26, -1)).lineTo(-20, -1).close().extrude(2.5, both=True)
    body = joined(body, [tab.translate((0, y, 0)) for y in (-8, 8)])
    grips = [W("XZ", origin=(13 + 2.2 * k, 0, 2.4)).circle(0.8).extrude(8, both=True) for k in range(4)]
    body = less(body, grips)
    return body.union(W().box(30, 1.2, 2).translate((-3, 0, -0.6))).union(W().box(1.2, 22, 1.6).translate((-3, 0, -0.6)))


@part(turn=True, offset=1.0)
def corner_foot():
    body = W().box(40, 40, 40, centered=False).edges("|Z").edges("<X and <Y").fillet(12).edges("<Z").fillet(4)
    body = body.cut(W().box(40, 40, 40, centered=False).translate((5, 5, 5)).edges("|Z").edges("<X and <Y").fillet(7))
    body = body.cut(W("XY", origin=(40, 40, -5)).circle(24).extrude(60))
    ribs = [W().polyline([(4, 20), (4, 22.4), (16, 22.4), (16, 20)]).close().extrude(16),
            W().polyline([(20, 4), (22.4, 4), (22.4, 16), (20, 16)]).close().extrude(16)]
    body = joined(body, ribs).union(disc(6, 6, -6, 17, 17).faces("<Z").edges().fillet(1.5))
    body = body.cut(lying(countersink(2, 4, 12), "-x").translate((0, 30, 28)))
    return less(body, [lying(countersink(2, 4, 12), "-y").translate((30, 0, 28)), disc(2.2, 30, -10, 17, 17)])
