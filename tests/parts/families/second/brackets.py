"""Brackets, clamps and levers."""
import math

import cadquery as cq

from ..register import part
from ..shapes import W, disc, turned, joined, less
from .outlines import counterbore, countersink, inside, link, lying, nearest


@part(turn=True, offset=1.0)
def gusset_bracket():
    body = W().box(72, 46, 7, centered=(False, True, False)).union(W().box(7, 46, 62, centered=(False, True, False)))
    body = body.edges("|Y").edges(nearest((7, 0, 7))).fillet(5)
    gusset = W("XZ").polyline([(4, 4), (50, 4), (50, 12), (12, 48), (4, 48)]).close().extrude(3.5, both=True)
    body = body.union(gusset).edges("|Z").edges(inside((49, -4, 6), (51, 4, 13))).fillet(3)
    body = body.edges(inside((10, -4, 6.5), (54, 4, 7.5))).fillet(2)
    body = body.edges("|Z").edges(">X").fillet(12).edges("|X").edges(">Z").fillet(8)
    body = less(body, [countersink(3, 6, 20).translate((58, y, 7)) for y in (-13, 13)])
    body = less(body, [W("YZ", origin=(-1, y, 42)).slot2D(16, 6.5, 90).extrude(10) for y in (-14, 14)])
    return body.edges("|Y").edges(nearest((0, 0, 0))).fillet(3)


@part(turn=True)
def obtuse_bracket():
    body = W("XZ").polyline([(-54, 0), (0, 0), (30, 51.962), (23.072, 55.962), (-4.619, 8), (-54, 8)]).close().extrude(19, both=True)
    body = body.edges("|Y").edges(nearest((0, 0, 0))).fillet(14).edges("|Y").edges(nearest((-4.6, 0, 8))).fillet(6)
    arm = cq.Plane((20, 0, 34.641), (0.5, 0, math.sqrt(0.75)), (-math.sqrt(0.75), 0, 0.5))
    body = body.union(W(arm).workplane(offset=7).circle(12).extrude(9))
    body = body.edges(nearest(arm.toWorldCoords((0, 0, 8)).toTuple())).fillet(3)
    body = body.edges(nearest(arm.toWorldCoords((0, 0, 16)).toTuple())).chamfer(0.8)
    body = body.cut(W(arm).workplane(offset=-1).circle(6).extrude(30)).cut(W(arm).workplane(offset=11).circle(8.5).extrude(10))
    body = body.edges("|Z").edges("<X").fillet(9)
    body = less(body, [W("XY", origin=(-34, y, -1)).slot2D(16, 7).extrude(20) for y in (-9, 9)])
    return less(body, [W("XY", origin=(-34, y, 5)).slot2D(21, 12).extrude(20) for y in (-9, 9)])


@part(turn=True, offset=0.5)
def bellcrank():
    arm = lambda body, angle: body.rotate((0, 0, 0), (0, 0, 1), angle)
    body = link(17, 10, 62, 9).union(arm(link(17, 9, 46, 9), 105)).edges("|Z").edges(inside((5, 5, -1), (25, 25, 10))).fillet(9)
    body = body.faces(">Z or <Z").edges().chamfer(0.8)
    bosses = [disc(12, 24, -6), disc(7, 17, -4, 62), arm(disc(6.5, 14, -1, 46), 105)]
    body = joined(body, bosses)
    for x, y, z in ((0, 0, 0), (62, 0, 0), (0, 0, 9), (62, 0, 9), (-11.906, 44.433, 9)):
        body = body.edges("%CIRCLE").edges(nearest((x, y, z))).fillet(1.5)
    body = less(body, [disc(7.5, 40, -10), disc(4, 40, -10, 62), arm(disc(3.5, 40, -10, 46), 105), W().box(3, 19, 60)])
    body = body.cut(W("XY", origin=(35, 0, 6)).slot2D(24, 9).extrude(10))
    return body.faces("<Z or >Z").edges("%CIRCLE").chamfer(0.6)


@part(turn=True)
def saddle_clamp():
    ring = W("XZ").circle(22).extrude(13, both=True).union(W().box(84, 26, 6, centered=(True, True, False)))
    body = ring.cut(W().box(200, 200, 60).translate((0, 0, -30)))
    body = body.edges("|Y").edges(inside((-23, -1, 5), (23, 1, 7))).fillet(6)
    body = body.edges("|Z").fillet(8).edges(inside((-60, -20, 3), (60, 20, 30))).edges("<Y or >Y").fillet(2)
    body = body.cut(W("XZ").circle(16).extrude(40, both=True)).cut(W("XZ").circle(18).extrude(4, both=True))
    body = less(body, [counterbore(2.75, 5.5, 2, 20).translate((x, 0, 6)) for x in (-33, 33)])
    return body.cut(countersink(2, 4, 20).translate((0, 0, 21)))


@part(offset=2.0, scale=0.5)
def split_collar():
    body = disc(27, 17).cut(disc(14, 60, -20)).faces(">Z or <Z").edges().edges(cq.selectors.RadiusNthSelector(-1)).fillet(1.5)
    body = body.faces(">Z or <Z").edges().edges(cq.selectors.RadiusNthSelector(0)).chamfer(1)
    body = body.cut(W().box(40, 2.4, 60).translate((25, 0, 0)))
    screw = lying(counterbore(2.6, 4.8, 9, 60), "+y").translate((20.3, 19, 8.5))
    body = body.cut(screw).cut(W("XZ", origin=(20.3, 1.5, 8.5)).circle(2.1).extrude(40))
    body = body.cut(W().box(4, 6, 60).translate((-14.5, 0, 0)).edges("|Z").fillet(0.6))
    return less(body, [disc(1.6, 60, -20, -20.5 * math.cos(a), 20.5 * math.sin(a)) for a in (-0.7, 0.7)])


@part(turn=True, offset=1.0)
def joint_yoke():
    side = W("YZ").rect(34, 60).extrude(30, both=True).translate((0, 0, 20)).union(W("YZ", origin=(0, 0, 50)).circle(17).extrude(30, both=True))
    ears = disc(24, 80).intersect(side)
    body = turned((0, -16), (17, -16), (18, -15), (18, 4), (24, 10), (24, 24), (0, 24)).union(ears)
    body = body.cut(W().box(26, 80, 80).translate((0, 0, 70)).edges("|Y").fillet(9))
    body = body.cut(W("YZ", origin=(0, 0, 50)).circle(8).extrude(60, both=True))
    body = less(body, [W("YZ", origin=(x, 0, 50)).circle(11).extrude(10 if x > 0 else -10) for x in (-20, 20)])
    body = less(body, [W("YZ", origin=(x, 0, 50)).circle(8.8).extrude(1.2) for x in (-17.6, 16.4)])
    body = body.cut(disc(9, 80, -30)).cut(W().box(5, 11.2, 60).translate((0, 5.6, 0))).cut(turned((0, -17), (11, -17), (9, -15), (0, -15)))
    return body.cut(W("YZ", origin=(0, 0, -6)).circle(2.5).extrude(40))


@part(turn=True)
def dovetail_slide():
    body = W().box(96, 64, 26, centered=(True, True, False)).edges("|Z").fillet(5).faces(">Z").edges().chamfer(1.2)
    body = body.cut(W("YZ").polyline([(-20, -1), (20, -1), (20, 0), (26.93, 12), (-26.93, 12), (-20, 0)]).close().extrude(60, both=True))
    body = less(body, [W("YZ", origin=(0, y, 11.6)).circle(1.2).extrude(60, both=True) for y in (-26.4, 26.4)])
    body = body.cut(W("XZ").polyline([(-4, 30), (4, 30), (4, 20), (8, 20), (8, 15), (-8, 15), (-8, 20), (-4, 20)]).close().extrude(60, both=True))
    body = less(body, [counterbore(3.3, 5.5, 7, 40).translate((x, y, 26)) for x in (-34, 34) for y in (-18, 18)])
    body = less(body, [lying(countersink(2.1, 3, 30), "-y").translate((x, -32, 6)) for x in (-30, 0, 30)])
    return less(body, [W("XZ", origin=(x, 0, 12)).circle(1.5).extrude(18, both=True) for x in (-24, 24)])
