"""Sheet metal: bends, drawn walls and louvres."""
from ..register import part
from ..shapes import W, disc, turned, joined, less
from .outlines import inside, nearest, rounded_rect, sheet


@part(turn=True, offset=1.0)
def joggle_bracket():
    body = sheet([(-40, 0), (-8, 0), (4, 12), (30, 12), (30, 40)], 2, 3, 44)
    tab = sheet([(10, 0), (34, 0), (34, 22)], 2, 3, 18).rotate((0, 0, 0), (0, 0, 1), 90).translate((-20, 0, 0))
    body = body.union(tab).edges("|Z").edges("<X").fillet(8).edges("|X").edges(">Z").edges(inside((25, -30, 30), (35, 30, 50))).fillet(6)
    body = less(body, [disc(3, 20, -10, x, -11) for x in (-32, -18)] + [W("XY", origin=(14, 0, 5)).slot2D(20, 6, 90).extrude(20)])
    body = less(body, [W("YZ", origin=(20, y, 30)).circle(2.6).extrude(20) for y in (-13, 13)])
    return body.cut(W("XZ", origin=(-20, 20, 14)).circle(3.5).extrude(-20))


@part(turn=True, scale=0.5)
def p_clip():
    ring = W("XZ").circle(12).extrude(7, both=True)
    low = W().box(34, 14, 2).translate((17, 0, -11))
    high = W().box(34, 14, 2).translate((17, 0, -8.6))
    body = ring.union(low).union(high).cut(W("XZ").circle(10).extrude(20, both=True))
    body = body.cut(W().box(40, 30, 0.4).translate((20, 0, -9.8)))
    body = body.edges("|Y").edges(nearest((9.3, 0, -7.6))).fillet(3)
    body = body.edges("|Z").edges(">X").fillet(5)
    return body.cut(disc(2.7, 30, -20, 25)).cut(W("XZ").circle(3).extrude(2, both=True).translate((0, 0, 12.5)))


@part(turn=True, offset=1.0)
def press_pan():
    def drawn(t):
        """What lies above the sheet's lower side, for t = 0, or its upper one."""
        cup = rounded_rect(84 - 2 * t, 54 - 2 * t, 16 - t, -18 + t).faces("<Z").edges().fillet(6 - t)
        dimple = turned((0, -30), (13 + t, -30), (13 + t, -18 + t), (9 + t, -14 + t), (0, -14 + t))
        body = rounded_rect(200, 200, 20, 30 - t).translate((0, 0, t)).union(cup).union(rounded_rect(84 - 2 * t, 54 - 2 * t, 16 - t, 10))
        return body.edges(inside((-45, -30, t - 0.1), (45, 30, t + 0.1))).fillet(4 + t).cut(dimple)
    body = drawn(0).cut(drawn(1.2)).intersect(W("XY", origin=(0, 0, -40)).rect(108, 78).extrude(80).edges("|Z").fillet(20))
    body = less(body, [disc(2.2, 10, -5, x, y) for x in (-48, 48) for y in (-14, 14)])
    return body.cut(disc(3, 80, -40)).cut(W("XZ", origin=(18, 0, -8)).circle(3).extrude(60))


@part(turn=True)
def louvre_panel():
    body = sheet([(-50, 14), (-50, 0), (50, 0), (50, 14)], 1.5, 2, 76).translate((0, 0, -0.75))
    pill = lambda r: W("YZ").circle(r).extrude(18, both=True).union(W().sphere(r).translate((18, 0, 0))).union(W().sphere(r).translate((-18, 0, 0)))
    half = W().box(80, 40, 40).translate((0, 20, 0))
    places = [(0, y, 0) for y in (-30, -14, 2, 18)]
    body = joined(body, [pill(7).intersect(half).intersect(W().box(80, 80, 40).translate((0, 0, -20))).translate(q) for q in places])
    body = less(body, [pill(5.6).intersect(half.translate((0, -1, 0))).translate(q) for q in places])
    body = less(body, [W("YZ", origin=(x - 5, y, 8)).circle(2).extrude(10) for x in (-50, 50) for y in (-26, 26)])
    return less(body, [W("XY", origin=(x, 0, -5)).slot2D(30, 4, 90).extrude(10) for x in (-36, 36)])
