"""Wheels, sprockets, racks and gears."""
import math

import cadquery as cq
import numpy as np

from ..register import part
from ..second.outlines import counterbore, inside, lying
from ..shapes import W, disc, turned, around, joined, less, toothed_wire


@part(turn=True, offset=1.0)
def chain_sprocket():
    n, roller = 17, 3.2
    pitch_r = 9.525 / (2 * math.sin(math.pi / n))
    body = disc(pitch_r + 3.2, 4.4).intersect(turned((0, 0), (pitch_r, 0), (pitch_r + 3.4, 1.4), (pitch_r + 3.4, 3), (pitch_r, 4.4), (0, 4.4)))
    mouth = W("XY", origin=(pitch_r, 0, -5)).polyline([(0, -roller), (8, -roller - 1.6), (8, roller + 1.6), (0, roller)]).close().extrude(20)
    gap = disc(roller, 20, -5, pitch_r).union(mouth)
    body = less(body, around(gap, n)).union(turned((0, 0), (15, 0), (15, 15), (14, 16), (0, 16)))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, 4.3), (1, 1, 4.5))).edges(cq.selectors.RadiusNthSelector(0)).fillet(1.5)
    body = body.cut(disc(8, 60, -20)).cut(W().box(5, 18.6, 60)).faces("<Z or >Z").edges("%CIRCLE").edges(cq.selectors.RadiusNthSelector(0)).chamfer(0.5)
    return body.cut(W("XZ", origin=(0, 0, 11)).circle(1.8).extrude(30))


@part(turn=True)
def gear_rack():
    body = W("XZ").rect(96, 14).extrude(8, both=True).translate((0, 0, -5))
    tooth = W("XZ").polyline([(-2.4, 1.5), (-1.55, 2), (-0.75, 4.8), (-0.75 + 0.2, 5), (0.55, 5), (0.75, 4.8), (1.55, 2), (2.4, 1.5)]).close().extrude(8, both=True)
    body = joined(body, [tooth.translate((x, 0, 0)) for x in np.linspace(-44.5, 44.5, 20)])
    body = body.faces("<X or >X").edges("|Z or |Y").chamfer(0.6)
    body = less(body, [lying(counterbore(2.2, 4, 4.5, 30), "-y").translate((x, -8, -6)) for x in (-36, 0, 36)])
    return less(body, [turned((0, -13), (1.5, -13), (1.5, -6), (0, -5)).translate((x, 0, 0)) for x in (-18, 18)])


@part(turn=True, offset=0.5)
def ring_gear():
    hollow = W(obj=cq.Solid.extrudeLinear(toothed_wire(-1, 30, 24.5, 28.5, 0.36, 0.14, 0.45), [], cq.Vector(0, 0, 12)))
    body = turned((0, 0), (34, 0), (34, 2), (38, 2), (38, 8), (37, 9), (0, 9)).cut(hollow)
    body = body.edges("%CIRCLE").edges(inside((-1, -1, 1.9), (1, 1, 2.1))).fillet(0.8)
    body = less(body, around(disc(1.7, 20, -5, 34.8), 6))
    return less(body, around(W("XY").moveTo(38.5, 0).circle(2.5).extrude(20).rotate((0, 0, 0), (0, 0, 1), 30), 6))


@part(turn=True, offset=1.0)
def castor_wheel():
    rim = W("XZ").moveTo(16, -9).lineTo(24, -9).threePointArc((33, 0), (24, 9)).lineTo(16, 9).close().revolve(360, (0, 0, 0), (0, 1, 0))
    body = rim.union(turned((0, -12), (8, -12), (8, 12), (0, 12))).union(disc(20, 5, -2.5))
    rib = W().box(14, 1.8, 14).translate((12, 0, 0))
    body = joined(body, around(rib, 8)).cut(disc(3.2, 60, -30))
    body = body.faces("<Z or >Z").edges("%CIRCLE").edges(cq.selectors.RadiusNthSelector(-1)).fillet(1)
    groove = turned((31.6, -1), (34, -1), (34, 1), (31.6, 1))
    return body.cut(groove).cut(turned((0, -13), (5, -13), (5, -8), (0, -8))).cut(turned((0, 8), (5, 8), (5, 13), (0, 13)))


@part(turn=True, offset=1.0, scale=3)
def flywheel():
    rim = turned((42, -12), (54, -12), (55, -11), (55, 11), (54, 12), (42, 12), (40, 9), (40, -9))
    hub = turned((0, -14), (14, -14), (15, -13), (15, 13), (14, 14), (0, 14))
    arc = W().moveTo(12, -2).threePointArc((28, -9), (44, -4)).lineTo(44, 4).threePointArc((29, -1), (12, 4)).close().extrude(5, both=True)
    body = joined(rim, around(arc, 5)).union(hub)
    body = body.cut(disc(7, 60, -30)).cut(W().box(4, 17.4, 60).intersect(W().box(4, 40, 80).translate((0, 20, 0))))
    body = body.cut(turned((53, -2), (56, -3), (56, 3), (53, 2)))
    holes = [lying(turned((0, -6), (2, -5), (2, 1), (0, 1)), "+x").translate((55, 0, 7.5)).rotate((0, 0, 0), (0, 0, 1), 90 * k + 20) for k in range(4)]
    return less(body, holes).cut(W("XZ", origin=(0, 0, 9)).circle(1.6).extrude(16))


@part(turn=True)
def jaw_coupling():
    body = turned((0, 0), (19, 0), (20, 1), (20, 29), (19, 30), (0, 30))
    gap = W("XY", origin=(0, 0, 19)).moveTo(8, -5).lineTo(24, -10).lineTo(24, 10).lineTo(8, 5).close().extrude(20).edges("|Z").edges("<X").fillet(3)
    body = less(body, around(gap, 3)).cut(disc(9.5, 30, 19))
    body = body.cut(disc(6, 60, -20)).cut(W("YZ", origin=(0, 0, 9)).circle(2).extrude(40))
    body = body.cut(W().box(10, 60, 8).translate((-22, 0, 9)))
    return body.cut(turned((0, -0.01), (9, -0.01), (9, 4), (7.5, 5.5), (0, 5.5)))
