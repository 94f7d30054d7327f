"""Cast housings and covers, machined where they meet others."""
from ..fifth.profiles import round_body
from ..register import part
from ..second.outlines import counterbore, inside, lying, rounded_rect
from ..shapes import W, disc, turned, around, joined, less


@part(turn=True, offset=1.0)
def flanged_bearing_unit():
    body = rounded_rect(86, 86, 14, 11).faces(">Z").edges().fillet(2).union(turned((0, 0), (32, 0), (32, 24), (27, 36), (0, 36)))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, 10.9), (1, 1, 11.1))).fillet(4)
    nipple = lying(disc(5, 36), "+x").rotate((0, 0, 0), (0, 0, 1), 45).translate((0, 0, 21))
    body = body.union(nipple).cut(lying(disc(1.5, 50), "+x").rotate((0, 0, 0), (0, 0, 1), 45).translate((0, 0, 21)))
    body = body.cut(W().sphere(27).translate((0, 0, 18))).cut(disc(20.5, 60, -5)).cut(W().box(50, 12, 22).translate((0, 0, 29)))
    return less(body, [counterbore(4.5, 8, 2, 20).translate((x, y, 11)) for x in (-32, 32) for y in (-32, 32)])


@part(turn=True, offset=0.5)
def clutch_cover():
    body = round_body((0, 0), (57, 0), (57, 7), (49, 7, 3), (45, 26, 9), (20, 30, 3), (18, 40, 2), (0, 40))
    ears = around(disc(8, 9, 0, 56), 6)
    ribs = around(W("XZ").polyline([(10, 27), (42, 24), (42, 29), (18, 37), (10, 37)]).close().extrude(2, both=True), 8)
    body = joined(body, ears + ribs).cut(round_body((0, -1), (44, -1), (41, 22, 7), (16, 26, 2), (14, 36), (0, 36)))
    body = body.cut(turned((0, 30), (9, 30), (9, 38.5), (10.6, 40.01), (0, 40.01)))
    body = body.union(lying(disc(9, 16), "+x").translate((36, 0, 16)).cut(round_body((0, -1), (44, -1), (41, 22, 7), (16, 26, 2), (0, 27))))
    body = body.cut(lying(disc(5, 40), "+x").translate((36, 0, 16)))
    return less(body, around(disc(3.2, 20, -5, 58), 6))


@part(turn=True, offset=1.0)
def tailstock():
    base = W().box(52, 76, 16, centered=(True, True, False)).edges("|Z").fillet(5)
    column = W("XY", origin=(0, 0, 14)).rect(36, 60).extrude(44, taper=4)
    barrel = W("XZ", origin=(0, 46, 60)).circle(18).extrude(92).faces("<Y or >Y").edges().fillet(2)
    body = base.union(column).edges(inside((-20, -31, 15.9), (20, 31, 16.1))).fillet(4).union(barrel)
    body = body.union(turned((0, 70), (9, 70), (9, 84), (7.5, 85.5), (0, 85.5)).translate((0, -18, 0)))
    body = body.cut(W("XZ").polyline([(-18, -0.01), (-11, 7), (-4, -0.01)]).close().extrude(60, both=True))
    body = body.cut(W("XZ").rect(14, 8).extrude(60, both=True).translate((14, 0, 0)))
    body = body.cut(W("XZ", origin=(0, 60, 60)).circle(10).extrude(120)).cut(lying(turned((0, -14), (10, -14), (12.5, 0.01), (0, 0.01)), "-y").translate((0, -46, 60)))
    body = body.cut(disc(3, 40, 60, 0, -18)).cut(W().box(2.5, 26, 40).translate((0, -40, 50)))
    return less(body, [W("XZ", origin=(0, 45, 60)).pushPoints([(13.6, 0), (-13.6, 0), (0, 13.6)]).circle(1.5).extrude(-10)] + [disc(4.5, 40, -5, 0, 30)])


@part(turn=True, offset=1.0)
def compressor_head():
    body = rounded_rect(84, 62, 10, 9).union(rounded_rect(70, 48, 9, 12).translate((0, 0, 8)))
    body = body.edges(inside((-36, -25, 8.9), (36, 25, 9.1))).fillet(3)
    fin = W().box(62, 2.6, 16, centered=(True, True, False)).edges("|X").edges(">Z").fillet(1.1).translate((0, 0, 19))
    body = joined(body, [fin.translate((0, y, 0)) for y in (-18, -12, -6, 0, 6, 12, 18)] + [disc(7, 24, 0, x, y) for x in (-33, 33) for y in (-23, 23)])
    ports = [lying(turned((0, 0), (10, 0), (10, 10), (9, 11), (0, 11)), axis).translate((x, 0, 12)) for axis, x in (("+x", 34), ("-x", -34))]
    body = joined(body, ports + [lying(turned((0, 0), (10, 0), (10, 8), (0, 8)), axis).translate((x, 0, 12)) for axis, x in (("+x", 30), ("-x", -30))])
    body = less(body, [rounded_rect(28, 40, 6, 16).faces(">Z").edges().fillet(3).translate((x, 0, -0.01)) for x in (-16, 16)])
    body = body.cut(lying(disc(6, 120, -60), "+x").translate((0, 0, 12)).cut(W().box(20, 40, 40)))
    return less(body, [counterbore(3.4, 5.2, 5, 40).translate((x, y, 24)) for x in (-33, 33) for y in (-23, 23)])


@part(turn=True, offset=0.5, scale=1.5)
def differential_case():
    body = W().sphere(34).union(turned((0, -25), (52, -25), (52, -16), (50, -14), (0, -14))).union(disc(15, 122, -61))
    body = body.edges("%CIRCLE").edges(inside((-1, -1, 25), (1, 1, 40))).fillet(4)
    body = body.cut(W().sphere(28)).cut(disc(9, 200, -100)).cut(W("XZ", origin=(0, 0, 7)).circle(15).extrude(60, both=True))
    body = body.cut(lying(disc(5.5, 120, -60), "+x").translate((0, 0, 7))).cut(W("XZ", origin=(26, 0, 7)).circle(1.6).extrude(40))
    body = less(body, [turned((0, -0.01), (10.5, -0.01), (9, 1.5), (0, 1.5)).translate((0, 0, -61)), turned((13.5, 44), (16, 44), (16, 47), (13.5, 47))])
    return less(body, around(disc(3.6, 20, -30, 43.5), 10))


@part(turn=True, offset=1.0, scale=2)
def valve_cover():
    body = rounded_rect(150, 60, 16, 36, 5).faces(">Z").edges().fillet(8).union(rounded_rect(168, 78, 22, 6))
    body = body.edges(inside((-76, -31, 5.9), (76, 31, 6.1))).fillet(4)
    body = joined(body, [W("XY", origin=(20, y, 34)).slot2D(90, 5).extrude(5) for y in (-15, -5, 5, 15)])
    body = body.union(turned((0, 30), (16, 30), (16, 48), (15, 49), (0, 49)).translate((-50, 0, 0)))
    body = joined(body, [disc(8, 11, 0, x, y) for x in (-66, 0, 66) for y in (-35, 35)])
    body = body.cut(rounded_rect(142, 52, 12, 32, 5).faces(">Z").edges().fillet(5).translate((0, 0, -0.01)))
    body = body.cut(turned((0, 20), (11, 20), (11, 46), (14, 49.01), (0, 49.01)).translate((-50, 0, 0)))
    body = body.union(lying(disc(7, 14), "+x").translate((68, 0, 20))).cut(lying(disc(4.5, 60), "+x").translate((60, 0, 20)))
    return less(body, [disc(3.3, 40, -5, x, y) for x in (-66, 0, 66) for y in (-35, 35)])
