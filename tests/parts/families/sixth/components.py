"""Connectors, power modules, a transformer, an ignition cap."""
from ..fifth.profiles import round_body, sector
from ..register import part
from ..second.outlines import counterbore, inside, rounded_rect
from ..shapes import W, disc, turned, around, joined, less


@part(turn=True, offset=1.0)
def distributor_cap():
    body = round_body((0, 0), (34, 0), (34, 22, 2), (31, 30), (0, 30))
    towers = around(turned((0, 20), (7, 20), (6.4, 48), (0, 48)).translate((22, 0, 0)), 6) + [turned((0, 20), (8, 20), (7, 55), (0, 55))]
    body = joined(body, towers).edges("%CIRCLE").edges(inside((-31, -31, 29.9), (31, 31, 30.1))).fillet(0.9)
    body = body.cut(turned((0, -1), (30.5, -1), (28, 20), (0, 24)))
    holes = around(turned((0, 34), (3, 34), (3, 46), (4.2, 48.01), (0, 48.01)).translate((22, 0, 0)), 6) + [turned((0, 38), (3.4, 38), (3.4, 56), (0, 56))]
    body = joined(less(body, holes), around(W().box(5, 3, 10).translate((22, 0, 17)), 6) + [turned((0, 18), (2.6, 18), (2, 25), (0, 25))])
    ear = W().box(14, 13, 6, centered=(True, True, False)).translate((35, 0, 0)).edges("|Z").edges(">X").fillet(4)
    ear = ear.cut(disc(33, 20, -5)).cut(disc(2.2, 20, -5, 38))
    return joined(body, [q.rotate((0, 0, 0), (0, 0, 1), angle) for q in (ear,) for angle in (30, 210)]).cut(sector(32, 40, 0.06, 4, -0.01))


@part(turn=True, offset=1.0)
def idc_header():
    body = W().box(32, 9, 9, centered=(True, True, False)).edges("|Z").chamfer(0.5).cut(W().box(28.6, 6.4, 20, centered=(True, True, False)).translate((0, 0, 2.4)))
    body = body.cut(W().box(4.4, 4, 20, centered=(True, True, False)).translate((0, -4, 2.4))).cut(W().box(2.6, 20, 3, centered=(True, True, False)).translate((12, 0, -1)))
    body = body.cut(W().box(2.6, 20, 3, centered=(True, True, False)).translate((-12, 0, -1)))
    pin = W().box(0.64, 0.64, 11.6, centered=(True, True, False)).faces("<Z or >Z").edges().chamfer(0.18).translate((0, 0, -3.2))
    body = joined(body, [pin.translate((2.54 * (k - 4.5), y, 0)) for k in range(10) for y in (-1.27, 1.27)])
    return body.cut(W("XZ", origin=(-11.4, -4, 7)).polyline([(-1, 0.8), (1, 0.8), (0, -0.8)]).close().extrude(4))


@part(turn=True, offset=0.5)
def pcb_transformer():
    core = W().box(48, 16, 40, centered=(True, True, False)).edges("|Y").fillet(1).translate((0, 0, 3))
    body = core.union(W().box(33, 30, 24, centered=(True, True, False)).edges("|Z").fillet(5).translate((0, 0, 11)))
    body = joined(body, [W().box(36, 34, 2, centered=(True, True, False)).edges("|Z").fillet(2).translate((0, 0, z)) for z in (9, 35)])
    body = body.union(W().box(50, 36, 4, centered=(True, True, False)).edges("|Z").chamfer(2))
    pins = [disc(0.5, 6, -4, x, y).faces("<Z").edges().chamfer(0.15) for x in (-20, -10, 0, 10, 20) for y in (-15, 15)]
    body = joined(body, pins + [W().box(5, 4, 6, centered=(True, True, False)).translate((x, y, 3)) for x in (-20, -10, 0, 10, 20) for y in (-15, 15)])
    return less(body, [W("XZ", origin=(x, 0, 23)).circle(1.8).extrude(20, both=True) for x in (-20.5, 20.5)] + [disc(1.7, 9, -1, x, 0) for x in (-21, 21)])


@part(turn=True, offset=1.0)
def power_module():
    body = rounded_rect(94, 34, 3, 10).union(W().box(78, 24, 17, centered=(True, True, False)).faces(">Z").edges().chamfer(1.2))
    body = body.edges("|X").edges(inside((-40, -13, 9.9), (40, 13, 10.1))).fillet(1)
    body = less(body, [disc(3.1, 30, -5, x) for x in (-43, 43)] + [W().box(7, 6.4, 40).translate((x, 0, 0)) for x in (-46.5, 46.5)])
    tabs = [W().box(15, 17, 1.2).translate((x, 0, 18.6)).edges("|Z").fillet(2).union(W().box(12, 1.2, 6).translate((x, 7.9, 16.2))) for x in (-25, 0, 25)]
    body = joined(body, tabs + [W().box(13, 13, 1.4).translate((x, 0, 17.4)) for x in (-25, 0, 25)])
    body = less(body, [disc(2.7, 30, 8, x, -1) for x in (-25, 0, 25)])
    blade = W("XZ").polyline([(-1.4, 8), (1.4, 8), (1.4, 20), (0.8, 21.4), (-0.8, 21.4), (-1.4, 20)]).close().extrude(0.5)
    return joined(body, [blade.translate((x, y, 0)) for x in (-36.6, 36.6) for y in (-7, -2, 3, 8)]).cut(rounded_rect(84, 28, 2, 1).translate((0, 0, -0.01)))


@part(turn=True, offset=1.0)
def xlr_socket():
    body = rounded_rect(26, 31, 3, 2.4).faces(">Z").edges().fillet(0.8).union(turned((0, -22), (11, -22), (11.5, -21), (11.5, 1), (0, 1)))
    body = body.cut(turned((0, -14), (8, -14), (8, -2), (9.2, 2.41), (0, 2.41))).cut(W().box(4, 4, 40).translate((0, 9.5, 5)).edges("|Z").fillet(1))
    face = disc(8.4, 5, -18)
    three = ((-0.94, 0.34), (0.94, 0.34), (0, -0.9))
    holes = [disc(1.3, 40, -19, 4 * c, 4 * s) for c, s in three]
    body = less(body.union(face), [q.intersect(disc(20, 20, -17)) for q in holes]).union(disc(1.6, 15, -14).faces(">Z").edges().fillet(0.5))
    cup = disc(1.5, 7, -28).cut(disc(0.9, 5, -29)).cut(W().box(4, 1.6, 5).translate((0, -1, -27.5)))
    body = joined(body, [cup.translate((5 * c, 5 * s, 0)) for c, s in three]).union(W().box(8, 6, 9).translate((0, 12, -5)).edges("|Z").edges(">Y").fillet(2))
    return less(body, [counterbore(1.6, 2.6, 0.8, 9).translate((x, y, 2.4)) for x, y in ((-9.5, 12), (9.5, -12))])
