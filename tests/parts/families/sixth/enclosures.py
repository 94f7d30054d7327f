"""Cases and plates of apparatus."""
from ..fifth.profiles import outline
from ..register import part
from ..second.outlines import countersink, rounded_rect
from ..shapes import W, disc, turned, joined, less


@part(turn=True, offset=1.0)
def remote_control_half():
    body = rounded_rect(50, 150, 12, 12).faces("<Z").edges().fillet(4).cut(rounded_rect(46, 146, 10, 20).faces("<Z").edges().fillet(2).translate((0, 0, 2)))
    body = body.union(rounded_rect(48, 148, 11, 2).cut(rounded_rect(46, 146, 10, 9, 0).translate((0, 0, -1))).translate((0, 0, 11)))
    posts = [(x, y) for x in (-18, 18) for y in (-58, 20)]
    body = joined(body, [turned((0, 1), (3.4, 1), (2.8, 10), (0, 10)).translate((x, y, 0)) for x, y in posts] + [W().box(47, 1.6, 6).translate((0, -20, 4.5))])
    body = less(body, [disc(1.1, 20, 3, x, y) for x, y in posts])
    body = less(body, [W("XY", origin=(x, y, -1)).slot2D(9, 6).extrude(5) for x in (-13, 0, 13) for y in (34, 44, 54, 64)])
    body = body.cut(disc(13, 5, -1, 0, 10)).cut(W("XZ", origin=(0, 80, 7)).slot2D(18, 5).extrude(10))
    ring = disc(13, 2, 0, 0, 10).cut(disc(10, 9, -2, 0, 10)).cut(disc(1, 9, -2, 0, 10))
    body = body.union(ring.translate((0, 0, 0.6)).cut(W().box(4, 40, 9).translate((0, 10, 0)))).union(W().box(27, 2, 1.4).translate((0, 10, 1.3)))
    return less(body, [W().box(1.4, 26, 4).translate((x, -45, 0)) for x in (-12, -6, 0, 6, 12)])


@part(turn=True, offset=1.0)
def din_rail_box():
    steps = outline((-45, 0), (45, 0), (45, 42, 2), (24, 42, 2), (24, 58, 3), (-24, 58, 3), (-24, 42, 2), (-45, 42, 2), plane="YZ", origin=(-18, 0, 0)).extrude(36)
    body = steps.faces("<X or >X").edges().chamfer(0.6)
    rail = outline((-18.6, -1), (18.6, -1), (18.6, 3.4), (16.4, 3.4), (16.4, 7), (-19.4, 7), (-19.4, 2), (-18.6, 2), plane="YZ", origin=(-30, 0, 0)).extrude(60)
    body = body.cut(rail).cut(W().box(12, 3, 12).translate((0, -25, 0))).union(W().box(10, 34, 3).translate((0, -36, -1.4)).edges("|Z").fillet(2))
    body = body.cut(W("XY", origin=(0, -48, -10)).slot2D(5, 2).extrude(20))
    spots = [(x, y) for x in (-11, 0, 11) for y in (-36, 36)]
    body = less(body, [turned((0, 34), (3, 34), (3, 41), (3.9, 42.01), (0, 42.01)).translate((x, y, 0)) for x, y in spots])
    body = less(body, [W().box(7, 10, 9).edges("|Y").fillet(1).translate((x, s * 42, 20)) for x in (-11, 0, 11) for s in (-1, 1)])
    body = body.cut(W("XY", origin=(0, 0, 57)).rect(26, 36).extrude(3).edges("|Z").fillet(3)).cut(disc(1.8, 9, 50, -8, 12)).cut(disc(4, 9, 55, 6, -8))
    return less(body, [W("YZ", origin=(-30, y, 50)).slot2D(8, 2, 90).extrude(60) for y in (-15, -9, -3, 3, 9, 15)])


@part(turn=True, offset=0.5)
def outlet_plate():
    body = rounded_rect(80, 126, 6, 7).faces(">Z").edges().fillet(3).cut(rounded_rect(74, 120, 4, 4).translate((0, 0, -0.01)))
    body = joined(body, [W().box(76, 1.6, 4, centered=(True, True, False)).translate((0, y, 0.6)) for y in (-56, 0, 56)])
    well = turned((0, 0), (17, 0), (18.5, 14), (0, 14)).cut(W().box(10, 5, 40).translate((0, 19, 0))).cut(W().box(10, 5, 40).translate((0, -19, 0)))
    cup = turned((0, -9), (19, -9), (20.5, 5), (0, 5))
    body = joined(body, [cup.translate((0, y, 0)) for y in (-30, 30)])
    body = less(body, [well.translate((0, y, -6)) for y in (-30, 30)])
    body = less(body, [disc(2.5, 20, -15, x, y) for x in (-9.5, 9.5) for y in (-30, 30)] + [disc(1.6, 20, -15, 0, y) for y in (-30, 30)])
    return body.cut(countersink(1.8, 3.4, 20).translate((0, 0, 7)))
