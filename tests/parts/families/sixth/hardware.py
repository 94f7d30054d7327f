"""Bolts, nuts, a lock and a clamp."""
import math

from ..fifth.profiles import outline, round_body
from ..register import part
from ..second.outlines import lying
from ..shapes import W, disc, turned, around, joined, less


def ridged(r, deep, pitch, z, count):
    """Points (r, z) up a shank with so many ridges for a thread."""
    rise = [(r - deep, 0.0), (r, 0.38), (r, 0.5), (r - deep, 0.88)]
    return [(q, z + pitch * (k + share)) for k in range(count) for q, share in rise]


@part(turn=True, offset=1.0)
def carriage_bolt():
    R = (13 ** 2 + 6 ** 2) / 12  # of the head
    curve = W("XZ").moveTo(0, 0).lineTo(12.6, 0).lineTo(13, 0.4).threePointArc((6.8, 6.4 - R + math.sqrt(R * R - 6.8 ** 2)), (0, 6.4)).close()
    head = curve.revolve(360, (0, 0, 0), (0, 1, 0))
    body = head.union(turned((0, -46), (4.2, -46), (4.6, -45.5), *ridged(5.4, 0.8, 2, -45, 12), (4.6, -21), (5.5, -20), (5.5, 1), (0, 1)))
    square = W().box(11, 11, 7, centered=(True, True, False)).translate((0, 0, -6.5)).edges("|Z").chamfer(0.7)
    return body.union(square.intersect(turned((0, -7), (5.8, -7), (9, -3.8), (9, 2), (0, 2)))).cut(turned((0, -47), (1.2, -47), (1, -44), (0, -43)))


@part(turn=True, offset=0.5)
def castle_nut():
    hexagon = W("XY").polygon(6, 38).extrude(16).intersect(turned((0, 0), (17.4, 0), (19.4, 1.2), (19.4, 14.8), (17.4, 16), (0, 16)))
    body = hexagon.union(round_body((0, 15), (14, 15), (14, 23, 1), (0, 23)))
    slot = W().box(30, 4, 9, centered=(False, True, False)).edges("|X").edges("<Z").fillet(1.9).translate((0, 0, 16.5))
    body = less(body, [q.rotate((0, 0, 0), (0, 0, 1), 30) for q in around(slot, 6)])
    bore = [(0, -0.01), (10.4, -0.01), (9, 1.4)] + [(r, z) for k in range(9) for r, z in ((9, 1.6 + 2.2 * k), (10, 2.3 + 2.2 * k), (10, 2.6 + 2.2 * k), (9, 3.3 + 2.2 * k))]
    return body.cut(turned(*bore, (9, 24), (0, 24)))


@part(turn=True, offset=1.0)
def cage_nut():
    cage = outline((-6.4, 0), (6.4, 0), (8, 2.2), (8, 4, 1), (6.2, 4), (6.2, 5.4, 1.6), (-6.2, 5.4, 1.6), (-6.2, 4), (-8, 4, 1), (-8, 2.2), plane="XZ").extrude(6.4, both=True)
    cage = cage.cut(W().box(10.6, 40, 3.6, centered=(True, True, False)).translate((0, 0, 1)))
    nut = W().box(9.8, 9.8, 3.6, centered=(True, True, False)).edges("|Z").chamfer(1).translate((0, 0, 1.01)).union(turned((0, -1), (4.4, -1), (4.4, 1.2), (0, 1.2)))
    bore = [(0, -2), (3.2, -2), (3.2, -1), (2.6, -0.4)] + [(r, z) for k in range(5) for r, z in ((2.6, 0.9 * k - 0.3), (3.1, 0.9 * k), (2.6, 0.9 * k + 0.3))]
    body = cage.cut(disc(4.8, 3, -1)).union(nut).cut(turned(*bore, (2.6, 6), (0, 6)))
    return less(body, [W("XY", origin=(x, 0, 5)).slot2D(7, 1.2, 90).extrude(1) for x in (-4.6, 4.6)])


@part(turn=True, offset=1.0)
def u_bolt():
    bend = W("XY", origin=(24, 0, 0)).circle(4).revolve(180, (-24, 0, 0), (-24, -1, 0))
    leg = turned((0, -52), (3.3, -52), *ridged(4, 0.6, 1.8, -52, 16), (4, -22), (4, 0), (0, 0))
    plate = W("XY", origin=(0, 0, -16)).slot2D(68, 17).extrude(-5).edges("%CIRCLE").chamfer(0.8)
    nut = W("XY", origin=(0, 0, -20.5)).polygon(6, 15).extrude(-7).intersect(turned((0, -28), (6.4, -28), (8, -26.6), (8, -20), (0, -20)))
    return joined(bend.union(plate), [q.translate((x, 0, 0)) for x in (-24, 24) for q in (leg, nut)])


@part(turn=True, offset=0.5)
def padlock():
    body = W().box(44, 20, 38, centered=(True, True, False)).edges("|Y").fillet(5).faces("<Y or >Y").edges().fillet(2)
    body = body.union(turned((0, -4), (8.5, -4), (9, -3.5), (9, 3), (0, 3)))
    legs = [disc(4, 30, 34, x) for x in (-13, 13)]
    bow = W("XY", origin=(13, 0, 64)).circle(4).revolve(180, (-13, 0, 0), (-13, -1, 0))
    body = joined(body, legs + [bow])
    body = body.cut(disc(5, 3, -4.01)).cut(W().box(1.6, 6, 14).translate((0, 0, 0)))
    grooves = [W().box(46, 1.2, 1.2).rotate((0, 0, 0), (1, 0, 0), 45).translate((0, y, z)) for y in (-10, 10) for z in (9, 29)]
    return less(body, grooves).cut(W("XZ", origin=(0, -9.6, 19)).slot2D(22, 9).extrude(3))


@part(turn=True, offset=1.0)
def c_clamp():
    frame = lambda half: outline((52, -2, 4), (52, 14, 4), (6, 14, 9), (6, 66, 9), (46, 66, 4), (46, 82, 4), (-12, 82, 18), (-12, -2, 18), plane="XZ").extrude(half, both=True)
    inner = outline((70, 2), (70, 10), (2, 10, 9), (2, 70, 9), (70, 70), (70, 78), (-8, 78, 15), (-8, 2, 15), plane="XZ")
    body = frame(3).union(frame(8).cut(inner.extrude(30, both=True)))
    body = body.union(disc(10, 22, 63, 44)).union(turned((0, 10), (10, 10), (10, 20), (8, 22), (0, 22)).translate((44, 0, 0)))
    body = body.cut(turned((0, 82), (5.8, 83), (7, 85.01), (0, 85.01)).translate((44, 0, 0)))
    screw = turned((0, 36), (7, 36), (7, 39), (4.9, 42), *ridged(5, 0.7, 2.4, 44, 22), (4.4, 98), (6, 98), (6, 110), (5, 111), (0, 111)).translate((44, 0, 0))
    bar = lying(disc(2.2, 60, -30), "+x").translate((44, 0, 104))
    tips = [W().sphere(3.4).translate((44 + x, 0, 104)) for x in (-30, 30)]
    return joined(body, [screw, bar] + tips)
