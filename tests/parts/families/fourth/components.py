"""Connectors, switches and other electronic components."""
from ..register import part
from ..second.outlines import inside, lying, rounded_rect
from ..shapes import W, disc, turned, around, joined, less


@part(turn=True)
def audio_plug():
    barrel = turned((0, -24), (4, -24), (5, -20), (5, -3), (4.2, -1), (4.2, 0), (0, 0))
    shaft = turned((0, -1), (1.75, -1), (1.75, 8), (1.5, 8), (1.5, 8.6), (1.75, 8.6), (1.75, 10.6), (1.5, 10.6), (1.5, 11.2), (1.75, 11.2),
                   (1.1, 12.3), (1.75, 13.2), (0.9, 14.4), (0, 14.4))
    relief = turned((0, -40), (1.6, -40), (2.6, -22), (0, -22))
    relief = less(relief, [W().box(4, 8, 0.9).translate((2.7 * (1 if k % 2 else -1), 0, -38 + 2 * k)) for k in range(6)])
    flute = disc(1.1, 12, -17, 5.6)
    body = joined(barrel, [shaft, relief])
    return less(body, around(flute, 12)).cut(disc(1.1, 12, -41))


@part(turn=True, offset=2.0)
def camera_module():
    body = rounded_rect(25, 24, 2, 1).cut(W().box(12, 30, 4).translate((0, 29, 0)))
    body = body.union(rounded_rect(8.6, 8.6, 0.6, 3.2).translate((0, 2, 0.9))).union(turned((0, 3), (3.6, 3), (3.6, 5.4), (3.3, 5.7), (0, 5.7)).translate((0, 2, 0)))
    body = body.cut(turned((0, 4.6), (1.2, 4.6), (2.3, 5.71), (0, 5.71)).translate((0, 2, 0)))
    lens = W().sphere(2.2).translate((0, 2, 3.2)).intersect(W().box(20, 20, 10).translate((0, 0, 9.3)))
    body = body.union(lens)
    body = body.union(W().box(17, 5, 2.6, centered=(True, True, False)).translate((0, -8.6, 0.9)).edges("|Y and >Z").chamfer(0.5))
    body = body.cut(W().box(15, 3, 0.5).translate((0, -10, 1.9)))
    caps = [W().box(w, 0.9, 0.8, centered=(True, True, False)).translate((x, y, 0.8)) for w, x, y in ((1.6, -8, 5), (1.6, -8, 2), (1.6, 8, -1), (2.2, 7.4, 6))]
    return less(joined(body, caps), [disc(1.05, 4, -1, x, y) for x in (-10.5, 10.5) for y in (-2.5, 10)])


@part(turn=True, offset=1.0)
def bnc_socket():
    body = W().box(14.5, 14.5, 13, centered=True).edges().fillet(1.2)
    barrel = lying(turned((0, 0), (6, 0), (6, 2.5), (4.8, 2.5), (4.8, 15), (4.4, 15.4), (0, 15.4)), "-x").translate((-7.2, 0, 0))
    body = body.union(barrel)
    body = body.cut(lying(turned((0, 4), (4.1, 4), (4.1, 16), (0, 16)), "-x").translate((-7.2, 0, 0)))
    inner = lying(turned((0, 3), (2.4, 3), (2.4, 13), (0, 13)).cut(turned((0, 5), (0.7, 5), (0.7, 12.5), (1.2, 13.01), (0, 13.01))), "-x").translate((-7.2, 0, 0))
    lugs = [W("XZ", origin=(-18.7, 0, 0)).circle(1).extrude(6 * s) for s in (-1, 1)]
    lugs = [q.cut(lying(disc(4.3, 60, -30), "-x")) for q in lugs]
    body = joined(body, [inner] + lugs)
    pins = [disc(0.9, 5, -11, x, y).faces("<Z").edges().chamfer(0.3) for x, y in ((3, -5), (3, 5))] + [disc(0.4, 5, -11, x, 0) for x in (0, 4)]
    return joined(body, pins).cut(turned((0, 7), (3, 7), (4.2, 5.8), (0, 5.8)))


@part(turn=True, offset=1.0)
def banana_jack():
    body = turned((0, 0), (7, 0), (7, 3), (6, 5), (0, 5)).union(turned((0, 4), (4.5, 4), (4.5, 9), (0, 9))).mirror("XY")
    body = body.union(turned((0, -0.5), (6.2, -0.5), (6.2, 1), (0, 1)))
    stud = turned((0, -26), (2.6, -26), (3, -25.6), (3, -8), (0, -8))
    stud = less(stud, [turned((2.6, z), (3.1, z - 0.5), (3.1, z + 0.5)) for z in (-24, -22.6, -21.2)])
    nut = W("XY", origin=(0, 0, -15)).polygon(6, 11).extrude(3).intersect(turned((0, -15), (4.7, -15), (5.7, -14), (5.7, -13), (4.7, -12), (0, -12)))
    washer = turned((0, -11.5), (5.5, -11.5), (5.5, -10.5), (0, -10.5))
    tag = W("XY", origin=(0, 0, -11.6)).moveTo(0, -2.6).lineTo(12, -1.6).threePointArc((13.6, 0), (12, 1.6)).lineTo(0, 2.6).close().extrude(0.6).cut(disc(0.8, 4, -13, 12))
    body = joined(body, [stud, nut, washer, tag])
    return body.cut(turned((0, -18), (2, -18), (2, 0), (3, 1.01), (0, 1.01))).faces(">Z").edges("%CIRCLE").edges(inside((-1, -1, 0), (1, 1, 2))).chamfer(0.3)
