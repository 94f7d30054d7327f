"""What hands and bodies hold on to or sit on."""
import math

import cadquery as cq

from ..register import part
from ..second.handles import swept_ellipses
from ..shapes import W, disc, turned, around, joined, less
from ..third.sections import closed_curve
from ..third.skins import under


@part(turn=True, offset=1.0)
def bicycle_saddle():
    def edge(a):
        wide = 15 + 34 * (0.5 - 0.5 * math.tanh((68 * math.cos(a) + 12) / 26))
        return 68 * math.cos(a), wide * math.sin(a)
    blank = W(obj=cq.Solid.extrudeLinear(closed_curve(edge, cq.Plane((0, 0, -40)), 28), [], cq.Vector(0, 0, 110)))
    height = lambda x, y: 22 + 0.0016 * (x - 12) ** 2 - 0.009 * y * y * (1 - x / 150) - 2 * math.exp(-(y / 6) ** 2)
    body = under(height, blank, 78, 60).cut(under(lambda x, y: height(x, y) - 4, blank, 78, 60))
    core = under(lambda x, y: height(x, y) - 2, blank, 78, 60)
    posts = [disc(4.5, 60, -2, x, y).intersect(core) for x, y in ((-44, -18), (-44, 18), (46, 0))]
    body = joined(body, posts)
    body = less(body, [disc(1.8, 12, -4, x, y) for x, y in ((-44, -18), (-44, 18), (46, 0))])
    return body.cut(W("XY", origin=(-4, 0, 0)).slot2D(52, 9).extrude(80))


@part(turn=True, offset=1.0)
def phone_handset():
    path = cq.Edge.makeSpline([cq.Vector(-78, 0, 8), cq.Vector(-40, 0, 27), cq.Vector(0, 0, 32), cq.Vector(40, 0, 27), cq.Vector(78, 0, 8)],
                              tangents=[cq.Vector(1, 0, 0.9), cq.Vector(1, 0, -0.9)])
    body = swept_ellipses(path, ((0, 16, 8), (0.25, 14, 9), (0.5, 13, 11), (0.75, 14, 9), (1, 16, 8)))
    cup = lambda r, x: turned((0, -10), (r - 2, -10), (r, -8), (r, 4), (r - 5, 15), (0, 15)).translate((x, 0, 0))
    body = body.union(cup(24, -78)).union(cup(21, 78))
    body = less(body, [disc(1.4, 6, -12, -78)] + [q.translate((-78, 0, 0)) for r, n in ((6, 6), (12, 12)) for q in around(disc(1.4, 6, -12, r), n)])
    body = less(body, [W().box(1.8, long, 6).translate((78 + x, 0, -9)) for x, long in ((-10, 16), (-5, 24), (0, 26), (5, 24), (10, 16))])
    return body.cut(W("YZ", origin=(90, 0, -3)).rect(7, 6).extrude(20))


@part(turn=True, offset=0.5)
def screwdriver_handle():
    curve = W("XZ").moveTo(0, 0).lineTo(8, 0).lineTo(8, 3).spline([(11, 9), (9.6, 22), (15.5, 54), (15.8, 84), (12, 98)], includeCurrent=True)
    body = curve.lineTo(10, 100).lineTo(0, 100).close().revolve(360, (0, 0, 0), (0, 1, 0))
    body = less(body, around(W("XY", origin=(20, 0, 20)).circle(6).extrude(100), 6))
    blade = turned((0, -92), (3.5, -92), (3.5, 1), (0, 1)).union(W("XY", origin=(0, 0, -12)).polygon(6, 11).extrude(13))
    tip = W("XZ").polyline([(0.5, -93), (4, -93), (4, -74), (3.6, -74)]).close().extrude(10, both=True)
    body = body.union(blade.cut(tip).cut(tip.mirror("YZ")))
    return body.cut(W("XZ", origin=(0, 0, 93)).circle(2.6).extrude(40, both=True)).cut(W("XY", origin=(0, 0, 98)).rect(3, 12).extrude(10))
