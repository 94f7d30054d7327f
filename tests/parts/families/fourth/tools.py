"""Tools, jaws and things that clamp: machined and forged."""
from ..register import part
from ..second.outlines import inside
from ..shapes import W, disc, turned, joined, less


@part(turn=True, offset=1.0)
def open_spanner():
    head = lambda r, gap, angle, x: (disc(r, 7, 0, x), W().rect(r * 2, gap).extrude(20).edges("|Z").edges("<X").fillet(gap * 0.2)
                                     .translate((r * 0.8, 0, -5)).rotate((0, 0, 0), (0, 0, 1), angle).translate((x, 0, 0)))
    small, large = head(12, 10, 165, -62), head(15, 13, 15, 62)
    shank = W().box(104, 13, 5, centered=(True, True, False)).translate((0, 0, 1)).edges("|X").fillet(1.5)
    shank = shank.cut(W("XY", origin=(0, 0, 5)).slot2D(70, 6).extrude(4)).cut(W("XY", origin=(0, 0, -1)).slot2D(70, 6).extrude(3))
    return shank.union(small[0]).union(large[0]).cut(small[1]).cut(large[1])


@part(turn=True)
def connecting_rod():
    big = W().circle(17).extrude(11, both=True)
    shank = W().polyline([(12, -9), (70, -6), (70, 6), (12, 9)]).close().extrude(6, both=True)
    body = big.union(disc(11, 22, -11, 78)).union(shank)
    body = body.edges("|Z").edges(inside((14, -12, -10), (72, 12, 10))).fillet(5)
    web = W().polyline([(24, -5), (62, -3.2), (62, 3.2), (24, 5)]).close().extrude(10).edges("|Z").fillet(2).faces("<Z or >Z").edges().fillet(1.2)
    body = body.cut(web.translate((0, 0, 2))).cut(web.translate((0, 0, -12)))
    bosses = [W("YZ", origin=(-9, y, 0)).circle(5.5).extrude(20) for y in (-17, 17)]
    body = joined(body, bosses).cut(disc(12, 60, -30)).cut(disc(7, 60, -30, 78))
    body = less(body, [W("YZ", origin=(-30, y, 0)).circle(2.6).extrude(60) for y in (-17, 17)])
    return body.faces("<Z or >Z").edges("%CIRCLE").chamfer(0.6).cut(W("YZ", origin=(80, 0, 0)).circle(1.2).extrude(20))


@part(turn=True, offset=3.0, scale=0.5)
def tee_nut():
    body = W().box(26, 26, 9, centered=(True, True, False)).edges("|Z").fillet(2).union(W().box(26, 15, 18, centered=(True, True, False)))
    body = body.edges("|X").edges(inside((-20, -9, 8.9), (20, 9, 9.1))).fillet(1)
    body = body.faces("<Z").edges("|X or |Y").chamfer(0.9).faces(">Z").edges("|X").fillet(2.5)
    body = body.cut(disc(5, 60, -10)).cut(turned((0, 17), (5, 17), (6.01, 18.01), (0, 18.01)))
    return body.cut(turned((0, -0.01), (6.01, -0.01), (5, 1), (0, 1)))
