"""Machined plates: pockets, grooves, serrations, rows of holes."""
import math

from ..register import part
from ..second.outlines import counterbore, lying
from ..shapes import W, disc, turned, less, radial


@part(turn=True, offset=0.5, scale=2)
def vise_jaw():
    body = W().box(90, 14, 32, centered=(True, False, False)).edges("|Y").chamfer(1.5)
    body = less(body, [W("YZ", origin=(-50, 0, 2.5 + 3 * k)).polyline([(-0.01, -1.2), (-0.01, 1.2), (1.2, 0)]).close().extrude(100) for k in range(4)])
    vee = W().polyline([(-7, -1), (-6, 0), (0, 6), (6, 0), (7, -1)]).close().extrude(40)
    body = body.cut(vee).cut(W().rect(2, 15).extrude(40))
    body = body.cut(W("YZ", origin=(-50, 0, 22)).polyline([(-1, -4), (0, -3), (3, 0), (0, 3), (-1, 4)]).close().extrude(100))
    body = less(body, [lying(counterbore(3.5, 5.8, 6.5, 20), "-y").translate((x, 0, 12)) for x in (-30, 30)])
    return less(body, [turned((0, 20), (2.6, 20), (2.6, 32.01), (0, 32.01)).translate((x, 9, 0)) for x in (-40, -14, 14, 40)])


@part(turn=True)
def baffle_plate():
    body = disc(50, 5).cut(W().box(120, 40, 20).translate((0, 54, 0))).edges("|Z").fillet(4)
    spots = [(8.5 * (x + y / 2), 7.36 * y) for x in range(-7, 8) for y in range(-5, 5)]
    holes = [(x, y) for x, y in spots if math.hypot(x, y) < 42 and y < 27]
    body = body.cut(W("XY", origin=(0, 0, -1)).pushPoints(holes).circle(2.8).extrude(10))
    sinks = [turned((0, 3.9), (2.8, 3.9), (3.91, 5.01), (0, 5.01)).translate((x, y, 0)) for x, y in holes if abs(y) < 1]
    body = less(body, sinks)
    return less(body, [W("XY", origin=(*radial(50, a), -1)).circle(4).extrude(10) for a in (-0.35, math.pi + 0.35, -math.pi / 2)])


@part(turn=True, offset=1.0)
def cold_plate():
    body = W().box(100, 70, 14, centered=(True, True, False)).edges("|Z").fillet(6)
    way = W("XY", origin=(0, 0, 14)).moveTo(-40, -24).lineTo(28, -24).threePointArc((36, -16), (28, -8)).lineTo(-28, -8)
    way = way.threePointArc((-36, 0), (-28, 8)).lineTo(28, 8).threePointArc((36, 16), (28, 24)).lineTo(-40, 24)
    round_tool = W("YZ", origin=(-40, -24, 14)).circle(4).sweep(way)
    body = body.cut(round_tool)
    ends = [W().sphere(4).translate((-40, y, 14)) for y in (-24, 24)]
    body = less(body, ends + [disc(2.5, 40, -5, -40, y) for y in (-24, 24)])
    ports = [turned((0, -0.01), (5, -0.01), (5, 5), (2.5, 6), (2.5, 8), (0, 8)).translate((-40, y, 0)) for y in (-24, 24)]
    body = less(body, ports)
    spots = [(x, y) for x in (-44, 0, 44) for y in (-31, 31)] + [(44, 0)]
    return less(body, [counterbore(1.8, 3.2, 3, 30).translate((x, y, 14)) for x, y in spots])
