"""Curves turned round an axis, and what grows on them; a drill, whose flutes wind round it."""
import math

import cadquery as cq
import numpy as np

from ..register import part
from ..second.outlines import lying
from ..shapes import W, disc, turned, around, joined, less


def spun(curve):
    """A closed profile in the plane of x and z turned round z."""
    return curve.close().revolve(360, (0, 0, 0), (0, 1, 0))


@part(turn=True, offset=1.0)
def baluster():
    curve = W("XZ").moveTo(0, 26).lineTo(10, 26).spline([(7, 32), (14, 50), (9.5, 74), (6, 92), (7.5, 104)], tangents=[(-0.6, 1), (0.4, 1)], includeCurrent=True)
    body = spun(curve.lineTo(0, 104)).union(turned((0, 103), (10, 103), (11.5, 104.5), (11.5, 106.5), (10, 108), (0, 108)))
    body = joined(body, [W().box(24, 24, 26, centered=(True, True, False)).faces("<Z or >Z").edges().chamfer(1.2).translate((0, 0, z)) for z in (0, 107.4)])
    body = body.union(turned((0, 88), (8.6, 88), (9.4, 89), (8.6, 90), (0, 90)))
    return less(body, [disc(4, 18, -1), disc(4, 30, 118), W("XZ", origin=(0, 0, 13)).circle(2).extrude(40)])


@part(turn=True, offset=1.0, scale=4)
def cooling_tower():
    waist = lambda z, grow: (math.sqrt(22 ** 2 + 0.14 * (z - 76) ** 2) + grow, z)
    heights = np.linspace(12, 100, 9)
    curve = W("XZ").moveTo(*waist(heights[0], 0)).spline([waist(z, 0) for z in heights[1:]], includeCurrent=True).lineTo(*waist(100, -3.2))
    shell = spun(curve.spline([waist(z, -3.2) for z in heights[::-1][1:]], includeCurrent=True))
    body = shell.union(turned((waist(98, -1)[0], 98), (waist(98, 1.4)[0], 98), (waist(100, 1.6)[0], 100), (waist(100, -1)[0], 100)))
    r = waist(12, -1.6)[0]
    ring = turned((r - 3, 0), (r + 6, 0), (r + 6, 2), (r - 3, 2))
    leg = disc(0.9, 15, -2).rotate((0, 0, 0), (1, 0, 0), 18).translate((r + 1, 2.2, 0))
    legs = [q for pair in (leg, leg.mirror("XZ")) for q in around(pair, 16)]
    collar = turned((r - 2.4, 10), (r + 2.6, 10), (r + 2.6, 14), (r - 2.4, 14))
    return joined(body.union(collar), [q.intersect(turned((0, 1), (90, 1), (90, 11), (0, 11))) for q in legs] + [ring])


@part(turn=True, offset=1.0)
def dish_reflector():
    bowl = lambda lift: [(r, r * r / 60 + lift) for r in np.linspace(0, 46, 8)]
    outer, inner = bowl(0), bowl(1.8)
    curve = W("XZ").moveTo(*outer[0]).spline(outer[1:], tangents=[(1, 0), (1, 2 * 46 / 60)], includeCurrent=True).lineTo(49, 35.3).lineTo(49, 37.1).lineTo(*inner[-1])
    body = spun(curve.spline(inner[::-1][1:], tangents=[(-1, -2 * 46 / 60), (-1, 0)], includeCurrent=True))
    middle = W("XZ").moveTo(0, 1).spline([(r, r * r / 60 + 1) for r in (8, 16, 24)], tangents=[(1, 0), (1, 0.8)], includeCurrent=True).lineTo(24, 40).lineTo(0, 40)
    hub = turned((0, -10), (11, -10), (12, -9), (12, 4), (0, 4)).cut(spun(middle))
    feed = turned((0, 0.6), (2, 0.6), (2, 30), (5, 33), (5, 41), (4, 42), (0, 42))
    body = joined(body, [hub, feed]).cut(turned((0, -11), (4, -11), (4, -2), (0, 0)))
    return less(body, around(disc(1.6, 60, 0, 40), 3) + [lying(disc(1.5, 30), "+x").translate((20, 0, -6))])


@part(turn=True, offset=0.5)
def airship():
    curve = W("XZ").moveTo(0, 0).spline([(11, 10), (19, 40), (17.5, 84), (8, 122), (3, 132)], tangents=[(1, 0), (-0.5, 1)], includeCurrent=True).lineTo(0, 132)
    body = spun(curve).union(turned((0, 131), (3, 131), (3.4, 133), (2, 138), (0, 139)))
    fin = W("XZ").polyline([(6, 104), (24, 116), (24, 130), (4, 128)]).close().extrude(1.2, both=True).edges("|Y").edges(">X").fillet(3)
    cabin = W().box(9, 9, 34).translate((22, 0, 52)).edges("|Y").edges(">X").fillet(3.5).edges("|Z").edges(">X").fillet(1.6)
    pod = turned((0, -6), (2, -6), (3, -4), (3, 4), (2, 7), (0, 7)).union(W().box(8, 1.6, 5).translate((-3, 0, 0))).translate((21, 0, 84))
    body = joined(body, around(fin, 4) + [cabin] + [pod.rotate((0, 0, 0), (0, 0, 1), angle) for angle in (-50, 50)])
    return less(body, [W("XZ", origin=(23.5, s * 4.51, 42 + 5 * k)).rect(3, 3).extrude(s * 0.6) for k in range(5) for s in (-1, 1)])


@part(turn=True, offset=1.0)
def twist_drill():
    body = turned((0, 0), (0.6, 0), (7, 3.8), (7, 78), (6.4, 80), (6.4, 84), (7, 85), (7, 118), (6.2, 119), (0, 119))
    flute = W("XZ", origin=(6.6, 0, -14)).ellipse(4.9, 7).sweep(W(obj=cq.Wire.makeHelix(56, 80, 6.6)).translate((0, 0, -14)), isFrenet=True)
    body = less(body, around(flute, 2))
    return less(body, [W().box(20, 4, 14).translate((0, s * 7.4, 108)) for s in (-1, 1)])
