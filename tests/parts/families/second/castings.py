"""Castings: draft, fillets, ribs and bosses, some machined."""
import math

import cadquery as cq
from OCP.BRepFilletAPI import BRepFilletAPI_MakeFillet

from ..register import part
from ..shapes import W, disc, turned, around, joined, less
from .outlines import counterbore, countersink, inside, nearest, rounded_rect, swelling


@part(turn=True, offset=1.0, scale=2)
def oil_pan():
    tub = lambda w, h, r, deep, x: rounded_rect(w, h, r, -deep, 4).faces("<Z").edges().fillet(5).translate((x, 0, 0))
    body = tub(100, 62, 14, 20, 0).union(tub(48, 52, 12, 46, 20))
    body = body.union(rounded_rect(126, 88, 16, 5)).edges(inside((-60, -40, -0.1), (60, 40, 0.1))).edges().fillet(3)
    body = body.cut(rounded_rect(94, 56, 11, -17, 4).faces("<Z").edges().fillet(3)).cut(rounded_rect(94, 56, 11, 10))
    body = body.cut(tub(42, 46, 9, 43, 20))
    body = body.union(disc(9, 6, -50, 20)).cut(disc(5, 20, -60, 20))
    spots = [(x, y) for x in (-56, 0, 56) for y in (-37.5, 37.5)] + [(x, 0) for x in (-56.5, 56.5)]
    return less(body, [disc(2.7, 20, -5, x, y) for x, y in spots])


@part(turn=True)
def lobed_cover():
    body = joined(disc(36, 8), around(disc(10, 8, 0, 42), 3)).edges("|Z").fillet(9)
    body = body.faces(">Z").edges().fillet(2)
    boss = turned((0, 4), (24, 4), (24, 8), (21.5, 26), (0, 26))
    ribs = around(W("XZ").polyline([(15, 6), (33, 6), (33, 8), (15, 24)]).close().extrude(2, both=True), 6, 60)
    body = joined(body.union(boss), [rib.rotate((0, 0, 0), (0, 0, 1), 30) for rib in ribs])
    body = body.faces(">Z").edges().fillet(2)
    body = body.cut(turned((0, -1), (19, -1), (19, 14), (17.5, 15.5), (12, 15.5), (12, 20), (9, 20), (9, 30), (0, 30)))
    body = body.cut(turned((27, -1), (29.5, -1), (29.5, 2), (27, 2)))
    return less(body, around(counterbore(3.2, 6, 3, 30).translate((42, 0, 9)), 3))


@part(turn=True, offset=0.7)
def valve_body():
    body = W().sphere(26).union(W("YZ").circle(14).extrude(44, both=True)).union(disc(13, 40)).union(disc(8, 32, -32))
    body = body.edges("%CIRCLE").edges(inside((-30, -30, -30), (30, 30, 30))).fillet(4)
    flange = lambda x: W("YZ", origin=(x, 0, 0)).circle(25).extrude(7).faces("<X or >X").edges().fillet(1)
    body = body.union(flange(39)).union(flange(-46)).union(turned((0, 34), (17, 34), (18, 35), (18, 41), (17, 42), (0, 42)))
    body = body.cut(W("YZ").circle(9.5).extrude(60, both=True)).cut(W().sphere(17)).cut(turned((0, 0), (8, 0), (8, 38), (11, 38), (11, 50), (0, 50)))
    body = body.cut(turned((0, -40), (4, -40), (4, -20), (2, -18), (2, 0), (0, 0)))
    bolts = [W("YZ", origin=(0, 20 * math.cos(a), 20 * math.sin(a))).circle(2.2).extrude(60, both=True) for a in (0.785, 2.356, 3.927, 5.498)]
    bolts = [bolt.cut(W().box(76, 100, 100)) for bolt in bolts]
    return less(less(body, bolts), around(disc(1.6, 20, 30, 14.4), 6))


@part(turn=True)
def v_block():
    body = W().box(70, 50, 52, centered=(True, True, False)).edges().chamfer(1)
    body = body.cut(W("XZ").polyline([(0, 26), (28, 54), (-28, 54)]).close().extrude(40, both=True))
    body = body.cut(W("XZ").center(0, 26).rect(4, 8).extrude(40, both=True)).cut(W("XZ", origin=(0, 0, 22)).circle(3).extrude(40, both=True))
    side = W().box(9, 60, 11).edges("|Y").fillet(1.5)
    body = body.cut(side.translate((35, 0, 18))).cut(side.translate((-35, 0, 18)))
    for s in (-1, 1):
        tool = countersink(2.5, 3.5, 14).rotate((0, 0, 0), (0, 1, 0), -45 * s).translate((16 * s, 0, 42))
        body = less(body, [tool.translate((0, y, 0)) for y in (-14, 14)])
    body = body.cut(W("XZ", origin=(0, 0, 0)).circle(9).extrude(40, both=True))
    return less(body, [turned((0, -1), (3.5, -1), (3.5, 12), (0, 14)).translate((x, 0, 0)) for x in (-22, 22)])


@part(turn=True, offset=1.0)
def lantern():
    body = turned((0, 0), (34, 0), (34, 6), (29, 6), (22, 44), (22, 48), (27, 48), (27, 53), (0, 53))
    body = body.cut(turned((0, -1), (26, -1), (26, 3), (24, 5), (17.5, 42), (17.5, 44), (15, 44), (15, 60), (0, 60)))
    body = body.edges(cq.selectors.RadiusNthSelector(-1)).fillet(1.5)
    window = W("YZ", origin=(0, 0, 25)).rect(22, 26).extrude(60).edges("|X").fillet(6)
    body = less(body, around(window, 4))
    body = less(body, around(disc(2.4, 20, -5, 30.5).rotate((0, 0, 0), (0, 0, 1), 45), 4))
    return less(body, around(countersink(1.6, 3, 20).translate((21, 0, 53)), 6))


@part(turn=True, offset=1.0)
def wing_nut():
    body = turned((0, 0), (11, 0), (11, 6), (8.5, 16), (0, 16))
    outline = W("XZ").moveTo(0, 2).lineTo(11, 2).lineTo(24, 12).threePointArc((26, 22), (17, 19)).lineTo(8, 10).lineTo(0, 10).close()
    wing = outline.extrude(2, both=True).edges("|Y").edges(inside((15, -5, 8), (30, 5, 30))).fillet(2)
    wing = wing.faces("<Y or >Y").edges(inside((12, -5, 5), (40, 5, 40))).chamfer(0.5)
    body = joined(body, around(wing, 2)).edges("%CIRCLE").edges(inside((-1, -1, 15.9), (1, 1, 16.1))).fillet(1.2)
    return body.cut(turned((0, -0.01), (5.5, -0.01), (4.2, 1.3), (4.2, 14.8), (5.4, 16.01), (0, 16.01)))


@part(turn=True, offset=1.0)
def barrel_pedestal():
    barrel = W("YZ", origin=(-38, 0, 44)).circle(24).extrude(76).faces("<X or >X").edges().fillet(2)
    column = rounded_rect(42, 36, 8, 44)
    body = column.union(barrel).edges(inside((-22, -20, 15), (22, 20, 35))).edges("not |Z").fillet(3)
    plate = W().box(76, 62, 8, centered=(True, True, False)).edges("|Z").fillet(9).faces(">Z").edges().fillet(2)
    body = body.union(plate).edges(inside((-23, -20, 7.9), (23, 20, 8.1))).fillet(4)
    body = body.cut(W("YZ", origin=(0, 0, 44)).circle(15).extrude(60, both=True)).cut(W("YZ", origin=(-40, 0, 44)).circle(18).extrude(14))
    body = body.cut(disc(3, 40, 50)).cut(W("XY", origin=(0, 0, 66)).circle(7).extrude(10))
    return less(body, [counterbore(3.2, 6, 2, 20).translate((x, y, 8)) for x in (-30, 30) for y in (-23, 23)])


@part(turn=True, offset=0.5)
def post_base():
    plate = W().box(96, 62, 14, centered=(True, True, False)).edges("|Z").chamfer(13)
    body = plate.union(disc(15, 52, 0, -12))
    tool = BRepFilletAPI_MakeFillet(body.val().wrapped)
    swelling(tool, body.edges(nearest((-12, 0, 14))).val(), (3, 9, 3))
    swelling(tool, body.edges(nearest((-12, 0, 52))).val(), (1.5, 5, 1.5))
    swelling(tool, body.edges(nearest((0, 31, 14))).val(), (2, 9, 5))
    tool.Add(4.0, body.edges(nearest((0, -31, 14))).val().wrapped)
    body = W(obj=cq.Shape.cast(tool.Shape()).Solids()[0])
    body = body.cut(turned((0, -1), (9, -1), (9, 30), (6, 33), (6, 60), (0, 60)).translate((-12, 0, 0)))
    body = body.cut(W("XZ", origin=(-12, 0, 36)).circle(3).extrude(40))
    body = less(body, [counterbore(3.3, 6, 4, 30).translate((30, y, 14)) for y in (-15, 15)])
    return body.cut(W("XY", origin=(-38, 0, -1)).slot2D(16, 7, 90).extrude(30))
