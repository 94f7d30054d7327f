"""Pipe fittings, a pressure vessel and a die: bends, domes, rounded corners."""
import math

from ..register import part
from ..second.outlines import inside, lying
from ..shapes import W, disc, turned, around, joined, less, radial


def bend(r, angle):
    """A solid pipe bend of radius 20 in the plane of x and z: from the origin down and towards x."""
    return W("XY").circle(r).revolve(angle, (20, 0, 0), (20, -1, 0))


@part(turn=True, offset=1.0)
def sink_trap():
    def pipe(r, grow):
        down = disc(r, 40 + grow).union(bend(r, 180))
        up = disc(r, 10, 0, 40).union(bend(r, 90).rotate((0, 0, 0), (1, 0, 0), 180).translate((40, 0, 10)))
        return down.union(up).union(W("YZ", origin=(60, 0, 30)).circle(r).extrude(34 + grow))
    nut = turned((0, 22), (15, 22), (16, 23), (16, 34), (14, 36), (0, 36))
    nut = less(nut, around(disc(2, 40, 15, 17), 10))
    body = pipe(10, 0).union(nut).union(lying(turned((0, 0), (13, 0), (13, 6), (0, 6)), "-x").rotate((0, 0, 0), (0, 0, 1), 180).translate((88, 0, 30)))
    body = body.union(turned((0, -34), (8, -34), (8, -27), (0, -27)).translate((20, 0, 0)))
    return body.cut(pipe(8, 1)).cut(W("XY", origin=(20, 0, -40)).rect(3, 10).extrude(8))


@part(turn=True)
def ball_valve_body():
    body = W().sphere(19)
    body = body.union(W("YZ").polygon(6, 32).extrude(-34)).union(W("YZ").circle(14).extrude(34))
    body = body.union(W("YZ", origin=(34, 0, 0)).circle(16).extrude(5).faces(">X").edges().fillet(1.5))
    body = body.union(disc(8.5, 27).faces(">Z").edges().chamfer(1)).edges("%CIRCLE").edges(inside((-1, -1, 15), (1, 1, 19))).fillet(3)
    body = body.cut(W().sphere(13)).cut(W("YZ", origin=(-50, 0, 0)).circle(9).extrude(100)).cut(disc(4.5, 60)).cut(disc(6, 20, 21))
    return body.cut(W("YZ", origin=(-34.01, 0, 0)).circle(11).extrude(12)).cut(W("YZ", origin=(32, 0, 0)).circle(11.5).extrude(12))


@part(turn=True, offset=1.0, scale=10)
def dished_tank():
    r, knuckle, crown = 25, 5, 45
    rise = crown - math.sqrt((crown - knuckle) ** 2 - (r - knuckle) ** 2)
    touch = (r - knuckle) / (crown - knuckle)
    corner = (crown * touch, rise - crown + crown * math.sqrt(1 - touch ** 2))
    half = (r - knuckle + knuckle * math.cos(0.5), knuckle * math.sin(0.5))
    profile = W("XZ").moveTo(0, -40).lineTo(r, -40).lineTo(r, 0).threePointArc(half, corner)
    profile = profile.threePointArc((crown * math.sin(0.2), rise - crown + crown * math.cos(0.2)), (0, rise)).close()
    body = profile.revolve(360, (0, 0, 0), (0, 1, 0))
    body = body.union(body.mirror("XY").translate((0, 0, -60)))
    body = body.union(disc(5, 20)).union(disc(9, 3, 17)).union(W("YZ", origin=(0, 0, -20)).circle(8).extrude(33)).union(W("YZ", origin=(30, 0, -20)).circle(12).extrude(4))
    legs = [W().box(5, 5, 34, centered=(True, True, False)).translate((18, 0, -94)).edges("|Z").fillet(1.2).union(disc(5, 2, -95, 18))]
    body = joined(body, [q.rotate((0, 0, 0), (0, 0, 1), 60) for q in around(legs[0], 3)])
    body = body.cut(disc(3.6, 30, 0)).cut(W("YZ", origin=(20, 0, -20)).circle(6).extrude(30))
    bolts = [W("YZ", origin=(25, *radial(10, k * math.pi / 4))).circle(0.9).extrude(20).translate((0, 0, -20)) for k in range(8)]
    return less(body, bolts).union(turned((0, -36), (26.5, -36), (26.5, -32), (0, -32)).cut(disc(24, 20, -45)))


@part(turn=True)
def shower_rose():
    body = turned((0, 0), (38, 0), (40, 2), (40, 7), (14, 17), (0, 17)).edges("%CIRCLE").edges(inside((-1, -1, 6.9), (1, 1, 7.1))).fillet(3)
    body = body.union(W().sphere(11).translate((0, 0, 22))).union(W("XY", origin=(0, 0, 28)).polygon(6, 20).extrude(12))
    body = body.cut(turned((0, 3), (35, 3), (35, 5), (11, 13), (0, 13))).cut(disc(5, 40, 10)).cut(turned((0, 33), (7.6, 33), (7.6, 41), (0, 41)))
    rings = [W("XY", origin=(0, 0, -2)).polarArray(r, 0, 360, n).circle(1.1).extrude(8) for r, n in ((12, 8), (27, 16))]
    body = less(body, rings).cut(turned((33, -1), (35, -1), (35, 0.8), (33, 0.8)))
    return less(body, around(W().sphere(3.5).translate((43, 0, 4.5)), 8))


@part(turn=True, offset=2.0, scale=0.3)
def playing_die():
    body = W().box(16, 16, 16).edges().fillet(2.2)
    pip = lambda x, y: W().sphere(2).translate((x, y, 9.2))
    q = 3.8
    sides = {1: [(0, 0)], 2: [(-q, -q), (q, q)], 3: [(-q, q), (0, 0), (q, -q)], 4: [(s * q, t * q) for s in (-1, 1) for t in (-1, 1)]}
    sides[5] = sides[4] + [(0, 0)]
    sides[6] = sides[4] + [(-q, 0), (q, 0)]
    ways = {1: ((1, 0, 0), 0), 6: ((1, 0, 0), 180), 2: ((1, 0, 0), 90), 5: ((1, 0, 0), -90), 3: ((0, 1, 0), 90), 4: ((0, 1, 0), -90)}
    return less(body, [pip(x, y).rotate((0, 0, 0), *ways[n]) for n in ways for x, y in sides[n]])
