"""Switches, displays and other electronic components."""
from ..register import part
from ..second.outlines import countersink, rounded_rect, sheet
from ..shapes import W, disc, turned, joined, less


@part(turn=True, offset=1.0)
def dip_switch():
    pitch = [2.54 * (k - 2.5) for k in range(6)]
    body = W().box(17.3, 9.8, 5.2, centered=(True, True, False)).faces(">Z").edges().chamfer(0.3)
    body = less(body, [W().box(1.5, 4.6, 3).translate((x, 0, 5.2)) for x in pitch])
    body = joined(body, [W().box(1.1, 1.6, 2.2).translate((x, y, 4.6)) for x, y in zip(pitch, (1.2, 1.2, -1.2, 1.2, -1.2, -1.2))])
    pin = W("XZ").polyline([(-0.6, 1), (0.6, 1), (0.6, -0.8), (0.25, -1.2), (0.25, -3), (-0.25, -3), (-0.25, -1.2), (-0.6, -0.8)]).close().extrude(0.15, both=True)
    body = joined(body, [pin.translate((x, y, 0)) for x in pitch for y in (-3.8, 3.8)])
    return body.cut(disc(0.5, 1, 4.9, -7.4, 3.7)).cut(W().box(2, 3, 1).translate((-8.65, 0, 0)))


@part(turn=True, offset=0.5)
def seven_segment_display():
    body = W().box(12.6, 19, 8, centered=(True, True, False)).cut(W().box(10.8, 16, 5))
    leaning = lambda points, x, y: W("XY", origin=(0, 0, 7.7)).polyline([(p + x + 0.15 * (q + y), q + y) for p, q in points]).close().extrude(2)
    across = [(-2.7, 0), (-2, 0.7), (2, 0.7), (2.7, 0), (2, -0.7), (-2, -0.7)]
    upright = [(q, p) for p, q in across]
    body = less(body, [leaning(across, -0.6, y) for y in (-6, 0, 6)] + [leaning(upright, x, y) for x in (-3.6, 2.4) for y in (-3, 3)])
    body = body.cut(disc(0.75, 2, 7.7, 4.2, -6.2)).union(W().box(9, 14.4, 1).translate((0, 0, 3)))
    return joined(body, [disc(0.28, 6.5, -3.6, x, y) for x in (-3.8, -1.9, 0, 1.9, 3.8) for y in (-5.6, 5.6)])


@part(turn=True, offset=1.0)
def bridge_rectifier():
    body = W().box(28.6, 28.6, 9, centered=(True, True, False)).edges("|Z").edges(">X and >Y").chamfer(4).edges("|Z").edges("<X or <Y").fillet(1.2)
    body = body.faces(">Z").edges().fillet(0.8).union(rounded_rect(24, 24, 2, 1.5).translate((0, 0, -1.2)))
    blade = W("XZ").polyline([(-3.15, 0), (-3.15, 19), (-2.2, 20.6), (2.2, 20.6), (3.15, 19), (3.15, 0)]).close().extrude(0.4, both=True)
    blade = blade.cut(W("XZ", origin=(0, 0, 17)).circle(0.9).extrude(2, both=True))
    foot = W().box(8, 2.6, 2).translate((0, 0, 9.2))
    spots = ((-8.6, -8.6, 0), (8.6, -8.6, 0), (-8.6, 8.6, 0), (8.2, 7.4, 90))
    body = joined(body, [q.rotate((0, 0, 0), (0, 0, 1), angle).translate((x, y, 0)) for x, y, angle in spots for q in (foot, blade.translate((0, 0, 1)))])
    return body.cut(countersink(2.6, 3.8, 30).translate((0, 0, 9))).cut(W("XY", origin=(0, -11.6, 8.6)).rect(6, 1.4).extrude(1))


@part(turn=True, offset=1.0)
def drum_inductor():
    body = turned((0, 1), (6, 1), (6, 2.2), (3.6, 2.2), (3.6, 8.2), (5.4, 8.2), (5.4, 9.4), (0, 9.4)).faces(">Z").edges().fillet(0.3)
    turns = [W().center(3.7, 0).circle(0.58).revolve(360, (-3.7, 0, 0), (-3.7, 1, 0)).rotate((0, 0, 0), (1, 0, 0), 90).translate((0, 0, 3 + 1.06 * k)) for k in range(5)]
    body = joined(body, turns).union(W().box(13, 13, 1.4, centered=(True, True, False)).edges("|Z").chamfer(3))
    body = body.cut(W().box(2.4, 60, 0.6))
    pads = [W().box(2.4, 4.6, 2, centered=(True, True, False)).translate((x, 0, -0.2)) for x in (-5.8, 5.8)]
    return joined(body, pads).cut(disc(0.6, 1, 9.2, 3.2))


@part(turn=True)
def microswitch():
    body = W("XZ").rect(20, 10).extrude(3.2, both=True).edges("|Y").edges(">Z").chamfer(0.8)
    body = less(body, [W("XZ", origin=(x, 0, -2.6)).circle(1.2).extrude(20, both=True) for x in (-4.75, 4.75)])
    body = body.cut(W("XZ", origin=(0, -3.2, 0)).rect(15, 1.2).extrude(-0.4).translate((0, 0, 2.8)))
    lever = sheet([(8.2, 4), (8.2, 6.6), (-9, 8.6), (-11.4, 7.4), (-13.4, 9)], 0.4, 0.5, 3.6)
    button = W().box(2.6, 2.4, 3).translate((-2.4, 0, 6)).edges("|Y").edges(">Z").fillet(1)
    blade = W("YZ").polyline([(-1.6, -4), (1.6, -4), (1.6, -7.6), (1, -8.4), (-1, -8.4), (-1.6, -7.6)]).close().extrude(0.25, both=True)
    blade = blade.cut(W("YZ", origin=(-2, 0, -6.9)).circle(0.6).extrude(4))
    return joined(body, [lever, button] + [blade.translate((x, 0, 0)) for x in (-8, 0.8, 8)])
