"""Pipe fittings and manifolds."""
import cadquery as cq

from ..register import part
from ..shapes import W, disc, turned, around, joined, less
from .outlines import lying


@part(turn=True, offset=1.0)
def lateral_wye():
    tilted = lambda body: body.rotate((0, 0, 0), (0, 1, 0), 45)
    run = turned((0, -40), (19, -40), (20, -39), (20, -26), (16, -22), (16, 46), (20, 50), (20, 63), (19, 64), (0, 64))
    branch = turned((0, 0), (12, 0), (12, 46), (15, 49), (15, 61), (14, 62), (0, 62))
    body = run.union(tilted(branch))
    body = body.cut(turned((0, -41), (16.5, -41), (16.5, -28), (13, -28), (13, 52), (16.5, 52), (16.5, 65), (0, 65)))
    return body.cut(tilted(turned((0, 0), (9, 0), (9, 50), (12, 50), (12, 63), (0, 63))))


@part(turn=True)
def banjo():
    ring = turned((0, -9), (14, -9), (16, -7), (16, 7), (14, 9), (0, 9)).edges(cq.selectors.RadiusNthSelector(-1)).fillet(2)
    tail = [(0, 0), (5.5, 0), (5.5, 22), (4.2, 24)] + [q for k in range(3) for q in ((4.2, 25 + 5 * k), (5, 25.5 + 5 * k), (4.2, 29 + 5 * k))] + [(3.6, 42), (0, 42)]
    body = ring.union(lying(turned(*tail), "+x"))
    body = body.cut(disc(8, 40, -20)).cut(W(obj=cq.Solid.makeTorus(9, 4))).cut(W("YZ").circle(2.4).extrude(60))
    seat = lambda z, s: turned((0, z), (11.5, z), (11.5, z + 0.8 * s), (0, z + 0.8 * s))
    return body.cut(seat(9, -1)).cut(seat(-9, 1))


@part(turn=True, offset=2.0, scale=2)
def rail_manifold():
    body = W("YZ", origin=(-75, 0, 0)).circle(17).extrude(150).faces("<X or >X").edges().chamfer(2)
    port = turned((0, 5), (8, 5), (8, 19), (6.5, 26), (0, 26))
    body = joined(body, [port.translate((x, 0, 0)) for x in (-48, -16, 16, 48)])
    foot = W().box(22, 50, 9).translate((0, 0, -16.5)).edges("|Z").fillet(5)
    body = joined(body, [foot.translate((x, 0, 0)) for x in (-56, 56)])
    body = body.cut(W("YZ").circle(7).extrude(100, both=True))
    body = less(body, [lying(turned((0, -22), (10, -22), (10, -2), (11.5, 0.01), (0, 0.01)), s).translate((x, 0, 0)) for s, x in (("+x", 75), ("-x", -75))])
    body = less(body, [turned((0, 0), (3, 0), (3, 18), (4, 26.01), (0, 26.01)).translate((x, 0, 0)) for x in (-48, -16, 16, 48)])
    sensor = turned((0, 0), (2.5, 0), (2.5, 11), (4, 11), (4, 13.5), (7, 13.5), (7, 40), (0, 40)).rotate((0, 0, 0), (1, 0, 0), 60)
    body = less(body, [sensor, sensor.translate((32, 0, 0))])
    return less(body, [disc(2.8, 40, -40, x, y) for x in (-56, 56) for y in (-20, 20)])


@part(turn=True, offset=1.0, scale=0.4)
def quick_coupler():
    body = turned((0, -24), (9, -24), (10, -23), (10, -6), (14, -6), (14, 0), (17, 0), (17, 30), (16, 31), (0, 31))
    body = body.union(W("XY", origin=(0, 0, -6)).polygon(6, 38).extrude(6).intersect(turned((0, -6), (17, -6), (19.5, -4.5), (19.5, 0), (0, 0))))
    body = body.cut(turned((0, -30), (5, -30), (5, -2), (8, 1), (8, 10), (11, 10), (11, 29), (13, 31.01), (0, 31.01)))
    body = body.cut(W(obj=cq.Solid.makeTorus(17.4, 2.2)).translate((0, 0, 25))).cut(turned((15.8, 7), (20, 7), (20, 12), (15.8, 12)))
    hole = lying(turned((0, -20), (2, -20), (2, -14.5), (2.6, -12), (2.6, 1), (0, 1)), "+x").translate((20, 0, 18))
    body = less(body, around(hole, 6))
    grooves = [turned((8.6, z), (10.1, z - 0.9), (11, z - 0.9), (11, z + 0.9), (10.1, z + 0.9)) for z in (-21, -18.6, -16.2, -13.8, -11.4)]
    return less(body, grooves).cut(turned((10, 14), (12, 14), (12, 16), (10, 16)))


@part(turn=True, offset=1.0)
def eccentric_reducer():
    oblique = lambda a, b, x, z: W("XY").circle(a).workplane(offset=z).center(x, 0).circle(b).loft(ruled=True)
    body = oblique(28, 16, 11, 44).union(disc(40, 7, -7)).union(disc(16, 14, 44, 11)).union(disc(20, 5, 53, 11))
    body = body.cut(oblique(24, 12.5, 11, 44)).cut(disc(24, 20, -19)).cut(disc(12.5, 40, 43.99, 11))
    return less(body, around(disc(2.8, 20, -10, 34), 6))
