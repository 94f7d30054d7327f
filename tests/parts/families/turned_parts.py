"""Turned parts, some of them milled afterwards."""
import math

import cadquery as cq

from .register import part
from .shapes import W, disc, turned, around, less


@part()
def hex_standoff():
    body = W().polygon(6, 5.5 / math.cos(math.pi / 6)).extrude(12)
    body = body.intersect(turned((0, 0), (2.75, 0), (3.4, 0.5), (3.4, 11.5), (2.75, 12), (0, 12)))
    body = body.union(turned((0, -6), (1.1, -6), (1.45, -5.6), (1.45, -1), (1.15, -0.8), (1.15, 0), (0, 0.1)))
    return body.cut(turned((0, 2), (1.25, 2.7), (1.25, 11.6), (1.7, 12.01), (0, 12.01)))


@part(turn=True, offset=2.0)
def v_pulley():
    body = turned((10, 0), (22, 0), (22, 4), (44, 4), (44, 1), (60, 1), (60, 4), (50, 8.5), (50, 11.5), (60, 16), (60, 19),
                  (44, 19), (44, 12), (22, 12), (22, 24), (10, 24))
    body = body.cut(W().box(6, 12.8, 60).translate((0, 6.4, 0)))
    body = less(body, around(disc(5, 30, 0, 33), 5))
    body = body.cut(W("YZ", origin=(0, 0, 18)).circle(2).extrude(40))
    return body.edges(cq.selectors.RadiusNthSelector(-1)).fillet(0.8)


@part(turn=True, offset=3.0)
def hose_barb():
    profile = [(2.8, -14), (5.6, -14), (6.4, -13), (6.4, -4), (5, -4), (5, 0)]
    profile += [(5, 10)] + [q for k in range(4) for q in ((6.1, 10 + 4 * k), (4.9, 14 + 4 * k))] + [(4, 27), (2.8, 27)]
    body = turned(*profile).union(W().polygon(6, 18).extrude(6).cut(disc(4, 20, -5)))
    return body.edges(cq.selectors.BoxSelector((-5.2, -5.2, 5.5), (5.2, 5.2, 6.5))).edges("%CIRCLE").fillet(1.2)


@part(offset=1.5, scale=0.05)
def ball_stud():
    body = turned((0, -30), (5, -30), (6, -29), (6, -10), (5.2, -10), (5.2, -8), (11, -8), (11, -3), (7.5, -3), (5.5, 12), (0, 12))
    body = body.union(W().sphere(10).translate((0, 0, 18))).edges(cq.selectors.BoxSelector((-7, -7, 8), (7, 7, 12))).fillet(2)
    body = body.edges(cq.selectors.BoxSelector((-8, -8, -3.2), (8, 8, -2.8))).edges(cq.selectors.RadiusNthSelector(0)).fillet(1.5)
    return body.cut(W().polygon(6, 5).extrude(6).translate((0, 0, -30.5)))


@part(turn=True)
def bearing_race():
    body = turned((30, -8.5), (30.5, -9), (40, -9), (40, 9), (30.5, 9), (30, 8.5)).edges(cq.selectors.RadiusNthSelector(-1)).fillet(1.2)
    groove = W(obj=cq.Solid.makeTorus(28, 5.2))
    body = body.cut(groove)
    seals = [turned((29, z), (31.2, z), (31.2, z + 1), (29, z + 1)) for z in (-8, 7)]
    return less(body, seals).cut(turned((39.2, -1), (41, -1), (41, 1), (39.2, 1))).cut(W("YZ").circle(0.8).extrude(60))


@part(turn=True, scale=0.1)
def cone_stack():
    profile = [(0, 0), (3.4, 0)] + [q for k in range(12) for q in ((4.0, 1 + k), (3.2, 1.5 + k))] + [(3.2, 14), (5, 14), (5, 16), (4.2, 17), (0, 17)]
    body = turned(*profile)
    return body.cut(W().box(1, 12, 3).translate((0, 0, 17)))


@part(turn=True, offset=1.0, scale=2.5)
def piston():
    body = disc(40, 60).edges(">Z").chamfer(1)
    body = less(body, [turned((36.5, z), (41, z), (41, z + 2), (36.5, z + 2)) for z in (52, 47)] + [turned((36, 40), (41, 40), (41, 43), (36, 43))])
    bosses = W("XZ", origin=(0, 0, 22)).circle(14).extrude(34, both=True).intersect(disc(35, 50))
    body = body.cut(disc(33, 32, -1).faces(">Z").edges().fillet(5)).union(bosses)
    body = body.cut(W("XZ", origin=(0, 0, 22)).circle(9).extrude(60, both=True))
    body = body.cut(W().box(120, 26, 60).intersect(disc(33, 30.5, -1)))
    return body.cut(W().sphere(50).translate((0, 0, 106)))


@part(turn=True)
def crank_throw():
    web = disc(22, 10).union(disc(16, 10, 0, 0, 35)).union(W().polyline([(-22, 0), (22, 0), (16, 35), (-16, 35)]).close().extrude(10))
    journal = lambda z: disc(12, 22, z)
    body = web.union(web.translate((0, 0, 30))).union(disc(11, 20, 10, 0, 35)).union(journal(-22)).union(journal(40))
    circles = body.edges("%CIRCLE").edges(cq.selectors.BoxSelector((-13, -13, -1), (13, 47, 41)))
    body = circles.edges(cq.selectors.RadiusNthSelector(0)).fillet(2)
    return body.cut(disc(3, 120, -40, 0, 35)).faces("<Z or >Z").edges().chamfer(1)


@part(turn=True, offset=2.0)
def socket_screw():
    body = turned((0, 0), (4, 0), (4, -24), (3.2, -25), (0, -25)).union(turned((0, 0), (6.5, 0), (6.5, 7), (6, 8), (0, 8)))
    body = body.edges(cq.selectors.BoxSelector((-4.2, -4.2, -0.1), (4.2, 4.2, 0.1))).edges(cq.selectors.RadiusNthSelector(0)).fillet(0.6)
    socket = W("XY", origin=(0, 0, 4)).polygon(6, 6.9).extrude(5).union(turned((0, 2.6), (2.9, 4), (0, 4)))
    return body.cut(socket).cut(turned((0, 7.2), (2.9, 7.2), (3.8, 8.01), (0, 8.01)))


@part(turn=True)
def dome_button():
    body = turned((0, 0), (12, 0), (12, 5), (0, 5)).intersect(W().sphere(40).translate((0, 0, -35.2)))
    body = body.edges(cq.selectors.BoxSelector((-13, -13, 2), (13, 13, 6))).fillet(1)
    body = body.union(turned((6, -8), (8, -8), (8.6, -7), (8, -6), (8, 0.5), (6, 0.5)))
    return less(body, [W().box(30, 2, 6).translate((0, 0, -6)), W().box(2, 30, 6).translate((0, 0, -6))])
