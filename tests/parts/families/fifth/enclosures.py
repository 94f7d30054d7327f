"""Cases, caps and covers of apparatus."""
from ..register import part
from ..second.outlines import rounded_rect
from ..shapes import W, disc, turned, around, joined, less
from .profiles import round_body, sector


@part(turn=True, offset=1.0)
def board_case():
    body = rounded_rect(92, 64, 6, 22).faces("<Z").edges().fillet(2).cut(rounded_rect(88, 60, 4, 30).translate((0, 0, 2)))
    body = body.union(rounded_rect(90, 62, 5, 3).cut(rounded_rect(88, 60, 4, 9)).translate((0, 0, 21)))
    posts = [turned((0, 1), (3.6, 1), (2.8, 7), (0, 7)).translate((x, y, 0)) for x in (-38, 20) for y in (-24.5, 24.5)]
    body = joined(body, posts + [W().box(1.6, 60.5, 5, centered=(True, True, False)).translate((32, 0, 1))])
    body = less(body, [disc(1.1, 8, 3, x, y) for x in (-38, 20) for y in (-24.5, 24.5)])
    body = body.cut(W("YZ", origin=(-50, 12, 12)).rect(14, 7).extrude(10)).cut(W("YZ", origin=(-50, -12, 12)).slot2D(9, 3.4).extrude(10))
    body = body.cut(W("XZ", origin=(-20, -25, 12)).circle(3.2).extrude(10)).cut(W("XZ", origin=(0, -25, 12)).rect(15, 6).extrude(10))
    return less(body, [W("XY", origin=(5 * k - 26, 0, -1)).slot2D(30, 2.2, 90).extrude(6) for k in range(8)])


@part(turn=True)
def keycap():
    body = rounded_rect(18, 18, 2, 9.4, 11).cut(W("XZ", origin=(0, 20, 33.6)).circle(26).extrude(40))
    body = body.cut(rounded_rect(15.4, 15.4, 1.2, 6.2, 10).translate((0, 0, -0.01)))
    stem = disc(2.75, 7.2, -0.6).cut(W().box(4.1, 1.2, 9)).cut(W().box(1.1, 4.1, 9))
    rib = W().box(14, 0.8, 3, centered=(True, True, False)).translate((0, 0, 4)).cut(W().box(4.1, 4.1, 20))
    return joined(body, [stem, rib, rib.rotate((0, 0, 0), (0, 0, 1), 90)])


@part(turn=True, offset=1.0)
def smoke_detector():
    body = round_body((0, 0), (52, 0), (52, 9, 3), (43, 10), (43, 20), (46, 22), (38, 33, 7), (0, 35))
    body = body.cut(turned((0, -1), (49, -1), (49, 5), (40, 7), (40, 24), (34, 31), (0, 32)))
    body = less(body, around(W().box(20, 8, 7).translate((44, 0, 15.2)), 20))
    body = body.union(disc(9, 5, 32).faces(">Z").edges().fillet(1.5)).cut(disc(1.6, 40, 10, 22, 0))
    body = less(body, [disc(1.3, 40, 10, -22 + 5 * x, 5 * y) for x in (-1, 0, 1) for y in (-1, 0, 1)])
    return joined(body, around(sector(46, 50, 0.12, 3, 0.8), 3))
