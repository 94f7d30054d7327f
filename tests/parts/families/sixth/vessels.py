"""A bottle, a gravy boat, a basin: lofts through closed curves."""
import math

import cadquery as cq

from ..register import part
from ..second.handles import swept_ellipses
from ..second.outlines import rounded_rect
from ..shapes import W, disc, turned, joined, less, radial
from ..third.sections import closed_curve, lofted, squarish
from .hand import spine


@part(turn=True, offset=1.0)
def twisted_bottle():
    lobed = lambda r, deep, turn: lambda a: radial(r * (1 + deep * math.cos(5 * (a - turn))), a)
    rows = ((0, 24, 0.05, 0), (16, 27, 0.07, 0.15), (48, 25, 0.09, 0.5), (76, 22, 0.07, 0.8), (96, 12.5, 0.03, 1))
    body = lofted([closed_curve(lobed(r, deep, turn), cq.Plane((0, 0, z)), 60) for z, r, deep, turn in rows])
    body = body.union(turned((0, 94), (10.4, 94), (10.4, 114), (10, 114.5), (0, 114.5))).union(turned((9, 97), (15, 97), (15, 98.6), (14, 99.6), (9, 99.6)))
    body = joined(body, [turned((9, z), (11.6, z + 0.7), (11.6, z + 1.2), (9, z + 1.9)) for z in (103, 108)])
    return body.cut(turned((0, -1), (17, -1), (15, 2), (0, 4))).cut(disc(8, 50, 84))


@part(turn=True, offset=1.0)
def gravy_boat():
    def lip(a, b, spout):
        def at(angle):
            x, y = squarish(a, b, 2.1)(angle)
            return x + spout * math.exp(-(math.atan2(math.sin(angle), math.cos(angle)) / 0.42) ** 2), y
        return at
    rows = ((6, 26, 20, 0), (18, 35, 27, 2), (36, 39, 30, 8), (52, 40, 31, 17))
    shell = lambda thin, low: lofted([closed_curve(lip(a - thin, b - thin, s), cq.Plane((0, 0, z - low)), 48) for z, a, b, s in rows])
    inner = shell(2.6, 0).intersect(W().box(300, 300, 200).translate((0, 0, 109)))
    handle = swept_ellipses(spine((-34, 44), (-60, 52), (-62, 28), (-28, 14), tangents=((-1, 0.4), (1, -0.3))), ((0, 6, 3.6), (0.3, 4.6, 3.4), (0.65, 4.6, 3.4), (1, 6, 4)))
    body = shell(0, 0).union(handle).union(turned((0, 0), (22, 0), (22, 2), (18, 6.4), (0, 6.4)))
    return body.cut(inner).cut(inner.translate((0, 0, 0.4))).cut(turned((0, -1), (19, -1), (17, 1.6), (0, 1.6)))


@part(turn=True, offset=0.5, scale=3)
def wash_basin():
    rows = ((-34, 22, 16, 2.2), (-26, 36, 24, 2.4), (-12, 42, 28, 2.8), (1, 45, 30, 3.2))
    bowl = lambda grow, low: lofted([closed_curve(squarish(a + grow, b + grow, p), cq.Plane((0, -4, z - low)), 40) for z, a, b, p in rows])
    body = rounded_rect(118, 92, 12, 8).translate((0, 0, -8)).union(bowl(3, 3).intersect(W().box(300, 300, 60).translate((0, 0, -33))))
    body = body.union(W().box(100, 10, 5).translate((0, 40, 1)).edges("|Z").fillet(4)).cut(bowl(0, 0))
    body = body.union(turned((0, -44), (9, -44), (9, -36), (0, -36)).translate((0, -4, 0))).cut(disc(5, 60, -60, 0, -4))
    body = body.cut(turned((0, -35), (5, -35), (8, -33.99), (8, -30), (0, -30)).translate((0, -4, 0)))
    body = body.cut(disc(5, 60, -20, 0, 36)).cut(W("XZ", origin=(0, 50, -12)).slot2D(12, 3).extrude(40))
    return less(body, [disc(2.2, 9, -9, x, y) for x in (-50, 50) for y in (-36, 36)])
