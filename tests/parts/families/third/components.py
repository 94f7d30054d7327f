"""Electronic components: bodies, leads, shafts and sockets."""
import math

import numpy as np

from ..register import part
from ..second.outlines import inside, lying, rounded_rect
from ..shapes import W, disc, turned, around, joined, less


@part(turn=True, offset=1.0)
def disc_capacitor():
    lens = W().sphere(9).translate((0, 0, -7)).intersect(W().sphere(9).translate((0, 0, 7))).edges().fillet(0.8)
    body = lens.rotate((0, 0, 0), (1, 0, 0), 90).translate((0, 0, 8))
    k = 1 - math.sqrt(0.5)
    path = W("XZ").moveTo(2.5, 5).lineTo(2.5, -1).threePointArc((2.5 + k, -1 - math.sqrt(0.5)), (3.5, -2))
    path = path.threePointArc((4.5 - k, -3 + math.sqrt(0.5)), (4.5, -3)).lineTo(4.5, -9)
    lead = W("XY", origin=(2.5, 0, 5)).circle(0.3).sweep(path)
    return joined(body, around(lead, 2))


@part(turn=True, scale=2)
def to220():
    tab = W().box(10, 1.3, 16, centered=(True, False, False)).edges("|Y").edges(">Z").chamfer(1)
    tab = tab.cut(W("XZ", origin=(0, 0, 13)).circle(1.8).extrude(-5)).cut(lying(turned((0, -1), (1.8, -1), (2.2, 0.01), (0, 0.01)), "-y").translate((0, 0, 13)))
    slug = W("XZ", origin=(0, 1, 4.5)).rect(10, 9.2).extrude(3.6, taper=4)
    body = tab.union(slug).cut(disc(1, 0.4).rotate((0, 0, 0), (1, 0, 0), 90).translate((-3, -2.3, 7)))
    outline = [(-0.7, 1), (0.7, 1), (0.7, -3.6), (0.4, -4.2), (0.4, -13), (0.2, -13.5), (-0.2, -13.5), (-0.4, -13), (-0.4, -4.2), (-0.7, -3.6)]
    lead = W("XZ", origin=(0, -0.9, 0)).polyline(outline).close().extrude(0.5)
    body = joined(body, [lead.translate((x, 0, 0)) for x in (-2.54, 0, 2.54)])
    return less(body, [W("YZ", origin=(x, 1.3, 10)).circle(0.7).extrude(2, both=True) for x in (-5, 5)])


@part(turn=True, offset=1.0)
def toggle_switch():
    body = W().box(13, 8, 9).translate((0, 0, -4.5)).edges("|Z").fillet(0.8).edges("<Z").chamfer(0.4)
    neck = [(0, -1), (3, -1), (3, 0.6)] + [q for k in range(5) for q in ((2.6, 0.8 + 1.2 * k), (3, 1.1 + 1.2 * k), (3, 1.7 + 1.2 * k))] + [(2.4, 7), (0, 7)]
    body = body.union(turned(*neck)).cut(turned((0, 4), (1.7, 7.01), (0, 7.01)))
    slope = math.atan(0.6 / 11)
    bat = turned((0, 4), (0.8, 4), (1.4, 15), (0, 15)).union(W().sphere(1.4 / math.cos(slope)).translate((0, 0, 15 + 1.4 * math.tan(slope))))
    body = body.union(bat.rotate((0, 0, 4.5), (0, 1, 4.5), 12)).cut(W().box(1, 3, 9).translate((-3, 0, 5)))
    lug = W("YZ").moveTo(-1, -8).lineTo(1, -8).lineTo(1, -13).threePointArc((0, -14), (-1, -13)).close().extrude(0.4, both=True)
    lug = lug.cut(W("YZ", origin=(-2, 0, -12.8)).circle(0.45).extrude(4))
    return joined(body, [lug.translate((x, 0, 0)) for x in (-4.7, 0, 4.7)])


@part(uniform=False, turn=True)
def pin_header():
    block = W().box(2.54, 5.08, 2.5, centered=(True, True, False)).edges("|Z").chamfer(0.5)
    end = lambda z: W("XY", origin=(0, 0, z)).rect(0.64, 0.64).extrude(0.6 if z > 0 else -0.6, taper=18)
    pin = W("XY", origin=(0, 0, -2.6)).rect(0.64, 0.64).extrude(10.8).union(end(8.2)).union(end(-2.6))
    body = joined(block, [block.translate((2.54 * k, 0, 0)) for k in range(1, 6)])
    return joined(body, [pin.translate((2.54 * k, y, 0)) for k in range(6) for y in (-1.27, 1.27)])


@part(turn=True, offset=0.5)
def barrel_jack():
    body = W().box(13, 9, 6.5, centered=(False, True, False)).union(W("YZ", origin=(0, 0, 6.5)).circle(4.5).extrude(13))
    body = body.union(W().box(3.5, 9, 11, centered=(False, True, False)).edges("|X and >Z").fillet(1.5))
    body = body.cut(W("YZ", origin=(-1, 0, 6.5)).circle(3.1).extrude(10.5))
    body = body.cut(lying(turned((0, -0.5), (3.1, -0.5), (3.6, 0.01), (0, 0.01)), "-x").translate((0, 0, 6.5)))
    pin = lying(turned((0, -12), (1, -12), (1, -1.6), (0.4, -1), (0, -1)), "-x").translate((0, 0, 6.5))
    body = body.union(pin)
    blade = W("YZ").moveTo(-1.2, 1).lineTo(1.2, 1).lineTo(1.2, -2.6).lineTo(0.6, -3.5).lineTo(-0.6, -3.5).lineTo(-1.2, -2.6).close().extrude(0.3, both=True)
    body = joined(body, [blade.translate((12, 0, 0)), blade.translate((6, 0, 0)), blade.rotate((0, 0, 0), (0, 0, 1), 90).translate((9, 3.8, 0))])
    return less(body, [W().box(1, 2, 1.4).translate((8, y, 10.8)) for y in (-2, 2)])


@part(turn=True)
def trimmer():
    body = W().box(9.5, 9.5, 5, centered=(True, True, False)).edges("|Z").chamfer(0.6).faces(">Z").edges().chamfer(0.25)
    body = body.cut(disc(3.2, 2, 3.6)).union(turned((0, 3), (2.8, 3), (2.8, 4.9), (2.5, 5.2), (0, 5.2)).cut(W().box(0.8, 4.4, 3).translate((0, 0, 5.9))))
    body = body.cut(W().box(0.8, 2, 3).translate((1, 0, 5.9)))
    standoffs = [W().box(1.2, 1.2, 1).translate((x, y, -0.3)) for x in (-3.8, 3.8) for y in (-3.8, 3.8)]
    pins = [disc(0.3, 4, -3.5, x, y).faces("<Z").edges().fillet(0.15) for x, y in ((-2.54, -2), (0, 2.6), (2.54, -2))]
    return joined(body, standoffs + pins).cut(W("YZ", origin=(4, 0, 2)).circle(0.9).extrude(4))


@part(turn=True, offset=1.0, scale=3)
def e_core():
    body = W().box(32, 9, 22, centered=(True, True, False))
    body = less(body, [W().box(6.2, 20, 17).translate((x, 0, 14)).edges("|Y").edges("<Z").fillet(1.5) for x in (-8.6, 8.6)])
    body = body.cut(W().box(11, 20, 1).translate((0, 0, 22)))
    body = body.cut(W("XZ", origin=(0, 0, 0)).circle(2.5).extrude(20, both=True))
    body = body.edges("|Z").edges(inside((-20, -10, 0), (-15, 10, 30)) + inside((15, -10, 0), (20, 10, 30))).fillet(1.2)
    return less(body, [W("XY", origin=(x, 0, -1)).circle(1.8).extrude(40) for x in (-16.2, 16.2)])


@part(uniform=False, turn=True)
def modular_socket():
    body = W().box(16, 15, 13, centered=(True, False, False)).edges("|Y and >Z").chamfer(0.5)
    body = body.cut(W().box(12, 20, 7, centered=(True, True, False)).translate((0, 0, 2)))
    body = body.cut(W().box(6.4, 20, 3, centered=(True, True, False)).translate((0, 0, 8.5)))
    body = body.cut(W().box(3.4, 20, 2, centered=(True, True, False)).translate((0, 0, 11)))
    wires = []
    for x in np.linspace(-3.57, 3.57, 8):
        wires.append(W("YZ", origin=(x, 0, 0)).polyline([(1.5, 1), (2.2, 1), (10.6, 5.4), (10.6, 6), (10, 6), (1.5, 1.6)]).close().extrude(0.25, both=True))
    body = joined(body, wires)
    posts = [disc(1.6, 4, -3, x, 9).faces("<Z").edges().chamfer(0.5).cut(W().box(0.7, 4, 6).translate((x, 9, -3))) for x in (-5.7, 5.7)]
    body = joined(body, posts)
    tails = [disc(0.25, 3.4, -3, x, 11.4 + 1.8 * (k % 2)) for k, x in enumerate(np.linspace(-3.57, 3.57, 8))]
    body = joined(body, tails)
    return less(body, [W().box(0.6, 5, 6, centered=(True, False, False)).translate((x, 4, 3)) for x in (-8, 8)])


@part(turn=True)
def buzzer():
    body = turned((0, 0), (6, 0), (6, 8.5), (0, 8.5)).faces(">Z").edges().fillet(0.7).union(turned((0, 1), (6.3, 1), (6.3, 2), (0, 2)))
    body = body.cut(disc(1.1, 4, 6.2)).cut(turned((0, 3), (4.6, 3), (4.6, 6.4), (0, 6.4)))
    body = body.cut(turned((3.6, 8.2), (4, 8.2), (4, 9), (3.6, 9)))
    body = joined(body, [disc(0.35, 6, -5.8, x).faces("<Z").edges().fillet(0.2) for x in (-3.2, 3.2)])
    bars = [W().box(1.6, 0.4, 2).translate((-4.95, 0, 8.9)), W().box(0.4, 1.6, 2).translate((-4.95, 0, 8.9))]
    return less(body, bars).cut(W("XZ", origin=(0, -4.5, 4.7)).circle(0.6).extrude(5))


@part(turn=True, offset=2.0)
def rotary_encoder():
    body = W().box(12, 13, 5.5, centered=(True, True, False)).edges("|Z").fillet(0.7)
    neck = [(0, 5), (3.5, 5), (3.5, 6.5)] + [q for k in range(4) for q in ((3.2, 6.7 + k), (3.5, 6.95 + k), (3.5, 7.5 + k))] + [(3, 11), (0, 11)]
    body = body.union(turned(*neck))
    shaft = turned((0, 10), (3, 10), (3, 12.2), (2.7, 12.2), (2.7, 13), (3, 13), (3, 24.6), (2.6, 25), (0, 25))
    body = body.union(shaft.cut(W().box(8, 8, 12).translate((0, 5.5, 20))))
    body = joined(body, [W().box(0.9, 0.4, 5).translate((x, -6.2, -1.5)).edges("|Y and <Z").chamfer(0.3) for x in (-2.5, 0, 2.5)])
    body = joined(body, [W().box(0.4, 2, 4.6).translate((x, 0, -1)).edges("|X and <Z").fillet(0.8) for x in (-5.7, 5.7)])
    return body.cut(rounded_rect(7, 7, 1, 0.6).translate((0, 0, -0.01)))
