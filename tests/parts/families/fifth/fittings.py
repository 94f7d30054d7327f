"""Pipe fittings and valves."""
import cadquery as cq

from ..register import part
from ..second.outlines import lying, rounded_rect
from ..shapes import W, disc, turned, around, joined, less
from .profiles import round_body


@part(turn=True, offset=1.0)
def y_strainer():
    slanting = lambda body: body.rotate((0, 0, 0), (0, 1, 0), 135)
    run = W("YZ", origin=(-38, 0, 0)).circle(13).extrude(76)
    ends = [W("YZ", origin=(x, 0, 0)).polygon(6, 36).extrude(15) for x in (-40, 25)]
    arrow = W("XZ", origin=(0, 0, 2)).polyline([(-9, -1.5), (2, -1.5), (2, -4), (9, 0), (2, 4), (2, 1.5), (-9, 1.5)]).close().extrude(13.8)
    branch = turned((0, 0), (12, 0), (12, 36), (15, 38), (15, 44), (0, 44)).union(W("XY", origin=(0, 0, 43)).polygon(6, 19).extrude(8))
    body = joined(run, ends + [slanting(branch), arrow])
    body = body.cut(W("YZ", origin=(-50, 0, 0)).circle(8).extrude(100)).cut(slanting(turned((0, 0), (9, 0), (9, 38), (0, 38))))
    return less(body, [lying(turned((0, -1), (11.4, -1), (10.4, 13), (0, 13)), axis).translate((x, 0, 0)) for axis, x in (("+x", -40), ("-x", 40))])


@part(turn=True, offset=1.0, scale=2)
def weld_neck_flange():
    body = round_body((12.5, 0), (28, 0), (28, 1.6), (46, 1.6), (46, 14), (25, 14, 3), (17, 34, 12), (17, 43), (14, 46), (12.5, 46))
    body = less(body, [turned((r - 0.7, -0.01), (r, 0.7), (r + 0.7, -0.01)) for r in (16, 19, 22, 25)])
    body = less(body, around(disc(3.6, 40, -10, 37), 8))
    return less(body, around(disc(6, 10, 13.2, 37), 8)).faces("<Z").edges("%CIRCLE").edges(cq.selectors.RadiusNthSelector(0)).chamfer(0.8)


@part(turn=True)
def gate_valve_body():
    body = rounded_rect(28, 44, 12, 64).faces("<Z").edges().fillet(6).translate((0, 0, -20))
    pipe = lying(round_body((0, -40), (28, -40), (28, -33), (16, -33, 3), (16, 33, 3), (28, 33), (28, 40), (0, 40)), "+x")
    body = body.union(pipe).union(rounded_rect(44, 60, 15, 7).translate((0, 0, 40)))
    body = body.cut(rounded_rect(15, 32, 6, 90).translate((0, 0, -15))).cut(W("YZ", origin=(-60, 0, 0)).circle(11).extrude(120))
    body = less(body, [W("YZ", origin=(-60, 22.5, 0)).circle(2.6).extrude(120).rotate((0, 0, 0), (1, 0, 0), 45 + 90 * k) for k in range(4)])
    body = less(body, [disc(2.4, 20, 35, x, y) for x, y in ((-15, -22), (15, -22), (-15, 22), (15, 22), (-17.5, 0), (17.5, 0))])
    return body.cut(rounded_rect(20, 37, 8, 10).translate((0, 0, 45)))


@part(turn=True, offset=1.0)
def sprinkler_head():
    thread = [(0, -13), (6.2, -13)] + [q for k in range(5) for q in ((7.2, -12 + 2.2 * k), (7.2, -11.5 + 2.2 * k), (6.4, -10.8 + 2.2 * k))] + [(6.4, 1), (0, 1)]
    body = turned(*thread).union(W("XY").polygon(6, 25).extrude(7).intersect(turned((0, 0), (11.5, 0), (12.5, 1), (12.5, 6), (11.5, 7), (0, 7))))
    bow = cq.Edge.makeThreePointArc(cq.Vector(8, 0, 5), cq.Vector(12, 0, 20), cq.Vector(2, 0, 37))
    arm = W(cq.Plane(bow.positionAt(0), (0, 1, 0), bow.tangentAt(0))).circle(2).sweep(W(obj=bow))
    body = joined(body, around(arm, 2)).union(turned((0, 33), (4, 33), (4.6, 38), (3, 42), (0, 42)))
    plate = less(disc(15, 1.2, 41), around(W("XY", origin=(13, 0, 40)).slot2D(9, 2).extrude(4), 12))
    bulb = turned((0, 6), (1.4, 6), (2.4, 12), (2.4, 26), (1.2, 33.5), (0, 33.5))
    return joined(body, [plate, bulb]).cut(disc(4.8, 15, -14))
