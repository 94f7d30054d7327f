"""Pipe fittings, nuts and nipples."""
import math

import cadquery as cq

from ..register import part
from ..second.outlines import inside, lying, nearest
from ..shapes import W, disc, turned, around, joined, less


@part(turn=True, offset=1.0)
def s_bend():
    k = math.sqrt(0.5)
    path = W("XZ").moveTo(0, 0).lineTo(0, 15).threePointArc((20 * (1 - k), 15 + 20 * k), (20, 35)).lineTo(30, 35)
    path = path.threePointArc((30 + 16 * k, 35 + 16 * (1 - k)), (46, 51)).lineTo(46, 66)
    flange = lambda z, x: turned((0, z), (19, z), (20, z + 1), (20, z + 5), (19, z + 6), (0, z + 6)).translate((x, 0, 0))
    body = W("XY").circle(11).sweep(path).union(flange(-4, 0)).union(flange(64, 46))
    body = body.edges("%CIRCLE").edges(nearest((0, 0, 2))).fillet(1)
    body = body.cut(W("XY").circle(8).sweep(path)).cut(disc(8, 20, -19)).cut(disc(8, 20, 65, 46))
    body = less(body, around(disc(2.2, 20, -10, 15.5), 4))
    return less(body, [bolt.translate((46, 0, 65)) for bolt in around(disc(2.2, 20, -10, 15.5), 4)])


@part(turn=True)
def cross_fitting():
    arm = turned((0, 0), (10, 0), (10, 20), (13, 20), (13, 31), (12, 32), (0, 32))
    turns = (0, 90, 180, 270)
    body = joined(W().sphere(15), [arm.rotate((0, 0, 0), (1, 0, 0), a) for a in turns])
    seat = turned((0, 23), (10, 23), (10, 31), (11, 32.01), (0, 32.01))
    body = body.cut(disc(6.5, 80, -40)).cut(W("XZ").circle(6.5).extrude(40, both=True))
    body = less(body, [seat.rotate((0, 0, 0), (1, 0, 0), a) for a in turns])
    hex_boss = W("YZ", origin=(10, 0, 0)).polygon(6, 14).extrude(7)
    return body.union(hex_boss).cut(W("YZ").circle(3).extrude(30)).cut(lying(turned((0, -1), (3, -1), (4, 0.01), (0, 0.01)), "+x").translate((17, 0, 0)))


@part(turn=True, offset=1.0)
def acorn_nut():
    body = W("XY").polygon(6, 24 / math.cos(math.pi / 6)).extrude(11).intersect(turned((0, 0), (11.5, 0), (14, 1.4), (14, 9.6), (11.5, 11), (0, 11)))
    collar = turned((0, -3), (14.5, -3), (15.5, -2), (15.5, -1), (14, 0.5), (0, 0.5))
    body = body.union(collar).union(disc(10, 5, 10)).union(W().sphere(10).translate((0, 0, 15)).intersect(W().box(60, 60, 30).translate((0, 0, 30))))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, 10.9), (1, 1, 11.1))).edges(cq.selectors.RadiusNthSelector(0)).fillet(1)
    body = body.cut(turned((0, -3.01), (7.6, -3.01), (6, -1.4), (6, 13), (0, 16.5)))
    return body.cut(turned((11, -3.01), (13, -3.01), (13, -2.4), (11, -2.4)))


@part(turn=True)
def y_splitter():
    barb = [(0, 0), (5, 0), (5, 12)] + [q for k in range(3) for q in ((5.9, 12.5 + 4 * k), (4.6, 16 + 4 * k))] + [(4, 26), (0, 26)]
    leg = turned(*barb)
    ways = [leg.rotate((0, 0, 0), (1, 0, 0), a) for a in (0, 125, 235)]
    body = joined(W().sphere(7.5), ways)
    body = body.union(W("YZ").polyline([(-7, 0), (7, 0), (4, -12), (-4, -12)]).close().extrude(1.5, both=True))
    bore = disc(2.8, 40)
    body = less(body, [W().sphere(3.6)] + [bore.rotate((0, 0, 0), (1, 0, 0), a) for a in (0, 125, 235)])
    return body.cut(W("YZ", origin=(0, 0, -9.5)).circle(1.2).extrude(10, both=True))


@part(turn=True, offset=2.0, scale=0.4)
def grease_nipple():
    start = W("XZ").moveTo(1.6, -14).lineTo(3.6, -14).lineTo(4.6, -13).lineTo(4.6, -2).lineTo(4, -1.6).lineTo(4, 0)
    start = start.lineTo(5, 0).lineTo(5, 6).lineTo(3.2, 8).lineTo(2.6, 11.4).threePointArc((3.4, 13.6), (2, 16.2))
    start = start.lineTo(1.4, 16.2).lineTo(0.9, 15.4).lineTo(0.9, 3).lineTo(1.6, 2).close()
    body = start.revolve(360, (0, 0, 0), (0, 1, 0))
    nut = W("XY").polygon(6, 14).extrude(5).intersect(turned((0, 0), (6.2, 0), (7, 0.7), (7, 4.3), (6.2, 5), (0, 5))).cut(disc(3, 20, -5))
    return body.union(nut)
