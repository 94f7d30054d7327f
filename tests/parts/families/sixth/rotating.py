"""Pulleys, couplings, cages and cutters."""
import math

import cadquery as cq

from ..fifth.profiles import round_body
from ..register import part
from ..second.outlines import counterbore, inside, lying
from ..shapes import W, disc, turned, around, joined, less, radial


@part(turn=True, offset=1.0)
def step_pulley():
    grooves = []
    for k, r in enumerate((46, 37, 28, 19)):
        z = 14 * k
        grooves += [(r, z + 0.6), (r, z + 2.6), (r - 5.5, z + 4.8, 0.6), (r - 5.5, z + 9.2, 0.6), (r, z + 11.4), (r, z + 13.4)]
    body = round_body((0, 0), (44, 0), *grooves, (16, 57), (16, 68, 1), (0, 68))
    body = body.cut(round_body((16, -1), (36, -1), (34, 8, 2), (27, 10, 2), (25, 22, 2), (16, 24, 2)))
    body = joined(body, around(W().box(24, 4, 8, centered=(False, True, False)).translate((14, 0, 0.6)), 5))
    body = body.cut(disc(7, 120, -20)).cut(W().box(4, 18.6, 200)).cut(lying(disc(2, 20), "+x").translate((0, 0, 63)))
    return body.edges("%CIRCLE").edges(">Z").edges(cq.selectors.RadiusNthSelector(0)).chamfer(0.7)


@part(turn=True, offset=0.5)
def oldham_hub():
    body = turned((0, 0), (24, 0), (25, 1), (25, 20), (0, 20)).union(W().box(50, 9, 6, centered=(True, True, False)).translate((0, 0, 19)).intersect(disc(25, 60, -5)))
    body = body.edges("|X").edges(">Z").chamfer(0.6)
    body = body.cut(disc(8, 60, -5)).cut(W().box(1.4, 40, 40).rotate((0, 0, 0), (0, 0, 1), 90).translate((-20, 0, 0)))
    screw = lying(counterbore(1.9, 3.4, 7, 40), "+y").translate((-16, 22, 9.5))
    body = body.cut(screw).cut(turned((0, -0.01), (9, -0.01), (8, 1), (0, 1)))
    return less(body, around(disc(2.2, 4, -0.01, 16.5).rotate((0, 0, 0), (0, 0, 1), 36), 5, 36))


@part(turn=True, offset=1.0)
def roller_cage():
    body = round_body((26, 0), (33, 0, 1), (38, 21.4, 2), (40, 22.4), (40, 24), (36.4, 24, 2), (31, 2.4, 1), (26, 2))
    window = W("XY", origin=(0, 0, 4)).polyline([(0, -2.6), (0, 2.6), (60, 5.1), (60, -5.1)]).close().extrude(15).edges(inside((10, -10, 3), (50, 10, 20))).fillet(0.8)
    return less(body, around(window, 17)).faces("<Z").edges("%CIRCLE").edges(cq.selectors.RadiusNthSelector(0)).chamfer(0.5)


@part(turn=True, offset=1.0)
def ball_screw_nut():
    body = turned((0, 0), (31, 0), (32, 1), (32, 9), (31, 10), (0, 10)).cut(W().box(100, 20, 40).translate((0, 34, 0))).cut(W().box(100, 20, 40).translate((0, -34, 0)))
    body = body.union(round_body((0, 5), (19, 5), (19, 52, 1.5), (0, 52))).edges("%CIRCLE").edges(inside((-1, -1, 9.9), (1, 1, 10.1)))
    body = body.edges(cq.selectors.RadiusNthSelector(0)).fillet(1.5)
    body = body.cut(W().box(22, 9, 30).translate((0, 21, 31)))
    pipe = W("YZ").moveTo(9, 20).lineTo(17.5, 20).threePointArc((19.62, 20.88), (20.5, 23)).lineTo(20.5, 39).threePointArc((19.62, 41.12), (17.5, 42)).lineTo(9, 42)
    body = body.union(W("XZ", origin=(0, 9, 20)).circle(2.2).sweep(pipe)).union(W().box(18, 2, 5).translate((0, 17.5, 31)))
    body = body.cut(disc(10, 80, -5)).cut(turned((0, -0.01), (13, -0.01), (13, 4), (0, 4)))
    body = body.cut(turned((0, 48), (12, 48), (12, 60), (0, 60)))
    rings = [W("XZ", origin=(10, 0, z)).circle(1.6).revolve(360, (-10, 0, 0), (-10, 1, 0)) for z in (12, 17, 22, 27, 32, 37, 42)]
    body = less(body, rings)
    bolts = [counterbore(2.4, 4, 4, 40).translate((*radial(25.5, math.radians(a)), 10)) for a in (-35, 0, 35, 145, 180, 215)]
    return less(body, bolts + [lying(disc(1.5, 30), "+x").translate((8, 0, 5))])


@part(turn=True, offset=1.0)
def shell_mill():
    body = turned((0, 0), (30, 0), (31, 1), (31, 16), (25, 26), (25, 44), (24, 45), (0, 45))
    pocket = W().box(40, 30, 40).translate((20, -15, -4)).intersect(W().box(60, 26, 60).translate((49, -13, 0)))
    gullet = pocket.edges("|Z").edges("<X").fillet(4).translate((0, 0, 4))
    body = less(body, around(gullet, 6))
    insert = W("XZ", origin=(27.5, 1.2, 5.2)).rect(11, 11).extrude(3.4, taper=9).edges("<Y").edges("|X or |Z").fillet(0.3)
    insert = insert.cut(W("XZ", origin=(27.5, 3, 5.2)).circle(1.7).extrude(9)).rotate((27.5, 0, 5.2), (0, 1, 0), 8)
    body = joined(body, around(insert, 6))
    body = body.cut(turned((0, -1), (14, -1), (14, 12), (9, 12), (9, 24), (11, 26), (11, 46), (0, 46)))
    return body.cut(W().box(8, 80, 12).translate((0, 0, 45)))


@part(turn=True, offset=0.5)
def hirth_ring():
    body = turned((18, 0), (40, 0), (41, 1), (41, 14), (18, 14))
    cutter = W("YZ", origin=(10, 0, 14)).polyline([(-3.2, 0.4), (3.2, 0.4), (0.5, -4.6), (-0.5, -4.6)]).close().extrude(40)
    body = less(body, around(cutter, 24)).cut(turned((24, 9), (31, 9), (31, 20), (24, 20)).union(turned((0, 9), (26, 9), (26, 20), (0, 20))))
    return less(body, around(counterbore(2.2, 3.8, 3, 30).translate((25.5, 0, 9)), 8)).cut(W("YZ").circle(2.5).extrude(60).translate((0, 0, 5)))
