"""Parts cut, bent and pressed from sheet and wire."""
from ..register import part
from ..second.outlines import countersink, inside, rounded_rect, sheet
from ..shapes import W, disc, turned, joined, less


@part(turn=True, offset=1.0)
def door_strike():
    body = sheet([(-16, 0), (13, 0), (20, -3), (25, -9)], 1.6, 5, 96)
    body = less(body, [W().box(30, 26, 40).translate((25, y, 0)) for y in (-35, 35)])
    body = body.edges("|Z").edges(inside((9, -23, -1), (11, 23, 1))).fillet(1.2).edges("|Z").edges("<Y or >Y").fillet(4)
    body = body.cut(W("XY", origin=(-3, 0, -5)).rect(14, 26).extrude(10).edges("|Z").fillet(2))
    body = less(body, [countersink(2.4, 3.6, 9).translate((-3, y, 0.8)) for y in (-38, 38)])
    body = less(body, [W("XY", origin=(-3, y, -5)).slot2D(7, 3.4, 90).extrude(9) for y in (-24, 24)])
    lip = W().box(4, 60, 4).translate((25, 0, -12)).rotate((25, 0, -9), (0, 1, 0), 40)
    return body.cut(lip)


@part(turn=True, offset=1.0)
def hasp_staple():
    plate = rounded_rect(42, 34, 7, 2.4).faces(">Z").edges().fillet(0.8)
    bow = W("XY", origin=(-9, 0, 0)).circle(3).extrude(14).union(W("XY", origin=(9, 0, 0)).circle(3).extrude(14))
    bend = W("XY", origin=(9, 0, 14)).circle(3).revolve(180, (-9, 0, 0), (-9, -1, 0))
    body = plate.union(bow).union(bend).edges("%CIRCLE").edges(inside((-10, -1, 2.3), (10, 1, 2.5))).fillet(1.2)
    return less(body, [countersink(1.7, 3.2, 9).translate((x, y, 2.4)) for x in (-16, 16) for y in (-11.5, 11.5)])


@part(turn=True, offset=0.5)
def octagon_box():
    prism = lambda across, h: W("XY").polygon(8, across).extrude(h).rotate((0, 0, 0), (0, 0, 1), 22.5)
    void = prism(101, 60).edges("|Z").fillet(3.6).faces("<Z").edges().fillet(1.6).translate((0, 0, 1.5))
    body = prism(104, 40).edges("|Z").fillet(5).faces("<Z").edges().fillet(3).cut(void)
    ear = W().box(12, 11, 1.5).edges("|Z").edges("<X").fillet(5).translate((42.5, 0, 39.2))
    body = joined(body, [ear, ear.rotate((0, 0, 0), (0, 0, 1), 180)])
    body = less(body, [disc(1.9, 9, 35, x) for x in (-40.5, 40.5)])
    knock = turned((10.4, -0.01), (11.4, -0.01), (11.4, 0.7), (10.4, 0.7))
    side = knock.rotate((0, 0, 0), (0, 1, 0), -90).translate((48.05, 0, 20))
    body = less(body, [side.rotate((0, 0, 0), (0, 0, 1), 45 * k) for k in (1, 2, 3, 5, 6, 7)] + [knock])
    return less(body, [W("XY", origin=(x, y, -1)).slot2D(12, 5, 45 if x * y > 0 else -45).extrude(9) for x in (-22, 22) for y in (-22, 22)] + [disc(2.2, 9, -2, 30)])


@part(turn=True, offset=1.0)
def belt_buckle():
    frame = rounded_rect(56, 48, 9, 5).cut(rounded_rect(44, 36, 4, 20).translate((0, 0, -5))).edges("not |Z").fillet(1.6)
    bar = W("XZ", origin=(-4, 20, 2.4)).circle(1.9).extrude(40)
    prong = W("XZ", origin=(0, 3, 0)).polyline([(-4, 0.6), (20, 2.2), (27, 4.4), (27, 7), (20, 5.4), (-4, 4.4)]).close().extrude(6).edges("|Z").edges(">X").chamfer(1.6)
    body = frame.union(bar).union(prong).union(W("XZ", origin=(-4, 4, 2.4)).circle(3.3).extrude(8))
    loop = rounded_rect(9, 52, 2, 9).cut(rounded_rect(20, 45, 2, 3).translate((0, 0, 3)))
    return body.union(loop.translate((-29, 0, -2)))
