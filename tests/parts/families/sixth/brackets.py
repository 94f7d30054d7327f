"""Clamps, plates and pedestals that hold something."""
from ..fifth.profiles import outline
from ..register import part
from ..second.outlines import counterbore, countersink, inside, rounded_rect
from ..shapes import W, turned, joined, less
from ..third.skins import blended


@part(turn=True, offset=1.0)
def solar_end_clamp():
    body = outline((0, 0, 0.8), (22, 0), (22, 4), (5, 4, 3), (5, 38, 4), (-10, 38, 1), (-10, 34.5, 0.6), (0, 34.5, 1.5), plane="XZ").extrude(20, both=True)
    body = body.edges("|Z").edges(">X").fillet(6)
    grooves = [W("XZ", origin=(1.6 * k - 8.6, 0, 34.5)).polyline([(-0.6, -0.01), (0.6, -0.01), (0, 0.6)]).close().extrude(30, both=True) for k in range(5)]
    body = less(body, grooves).cut(W("XY", origin=(13, 0, -1)).slot2D(10, 6.6).extrude(10)).cut(W("YZ", origin=(-5, 0, 19)).slot2D(20, 9).extrude(20))
    return less(body, [W("XZ", origin=(x, 0, -0.01)).rect(1, 1).extrude(30, both=True) for x in (7, 19)])


@part(turn=True, offset=0.5)
def lifting_plate():
    upright = outline((-26, 4), (26, 4), (17, 58, 14), (-17, 58, 14), plane="XZ").extrude(5, both=True)
    body = rounded_rect(78, 48, 10, 8).union(upright).edges(inside((-27, -6, 7.9), (27, 6, 8.1))).fillet(4)
    body = body.cut(W("XZ", origin=(0, 0, 41)).circle(9).extrude(20, both=True)).edges("%CIRCLE").edges(inside((-1, -6, 40), (1, 6, 42))).fillet(2)
    body = body.cut(W("XZ", origin=(0, 0, 17)).slot2D(22, 7).extrude(20, both=True))
    return less(body, [countersink(3.4, 6.4, 20).translate((x, y, 8)) for x in (-29, 29) for y in (-15, 15)])


@part(turn=True, offset=1.0)
def servo_cradle():
    wall = outline((-28, 4), (28, 4), (28, 34, 5), (-28, 34, 5), plane="XZ", origin=(0, 13, 0)).extrude(4)
    ribs = [W("YZ", origin=(x - 2, 0, 0)).polyline([(10, 5), (10, 31), (-9, 5)]).close().extrude(4) for x in (-25, 25)]
    body = joined(W().box(60, 26, 6, centered=(True, True, False)).edges("|Z").fillet(4).union(wall), ribs)
    body = body.edges("|X").edges(inside((-23, 8.9, 5.9), (23, 9.1, 6.1))).fillet(2.5)
    body = body.cut(W("XZ", origin=(0, 20, 20)).rect(38, 19).extrude(20).edges("|Y").fillet(1.5))
    body = less(body, [W("XZ", origin=(x, 20, z)).circle(1.3).extrude(20) for x in (-20.8, 20.8) for z in (15, 25)])
    body = less(body, [counterbore(1.7, 3.2, 2.4, 20).translate((x, -6, 6)) for x in (-18, 18)])
    return body.cut(W("XY", origin=(0, -5, -1)).slot2D(20, 8).extrude(20))


@part(turn=True, offset=1.0)
def hex_pedestal():
    body = blended(W("XY").polygon(6, 44).extrude(52), ((22, 0, 26), (2, 9, 3)), ((-22, 0, 26), (2, 9, 3)), ((11, 19.05, 26), (7, 2.5, 6)), ((-11, -19.05, 26), (7, 2.5, 6)))
    body = body.union(rounded_rect(74, 62, 9, 9)).union(turned((0, 51), (14, 51), (14, 56), (12.5, 58), (0, 58)))
    body = body.faces("<Z").edges().chamfer(1).cut(turned((0, -1), (12, -1), (12, 30), (8, 36), (8, 60), (0, 60)))
    body = less(body, [counterbore(3.2, 5.6, 3.4, 20).translate((x, y, 9)) for x in (-30, 30) for y in (-24, 24)])
    return body.cut(W("XZ", origin=(0, 0, 44)).circle(2.5).extrude(40))
