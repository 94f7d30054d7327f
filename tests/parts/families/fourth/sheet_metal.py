"""Parts bent and pressed from sheet."""
import math

from ..register import part
from ..second.outlines import rounded_rect, sheet
from ..shapes import W, disc, turned, joined, less


@part(turn=True, offset=1.0)
def slot_cover():
    body = sheet([(-11, 0), (0, 0), (0, -118)], 0.9, 0.8, 18.4)
    body = body.cut(W("YZ", origin=(0, 0, -118)).polyline([(-10, -1), (-4.5, -1), (-5.5, 6), (-10, 9)]).close().extrude(5, both=True))
    body = body.cut(W("YZ", origin=(0, 0, -118)).polyline([(10, -1), (4.5, -1), (5.5, 6), (10, 9)]).close().extrude(5, both=True))
    body = body.cut(W("XY", origin=(-8.2, 5.6, -5)).slot2D(9, 4.4).extrude(10))
    ports = [W("YZ", origin=(0, 0, -26)).rect(13, 22).extrude(5, both=True).edges("|X").fillet(1.5), W("YZ", origin=(0, 0, -58)).circle(4.6).extrude(5, both=True)]
    vents = [W("YZ", origin=(0, 0, -74 - 4 * k)).slot2D(12, 1.8).extrude(5, both=True) for k in range(8)]
    return less(body, ports + vents)


@part(turn=True, offset=1.0)
def fuse_clip():
    foot = W().box(7, 8, 0.6, centered=(True, True, False))
    ring = W("XZ", origin=(0, 0, 3.8)).circle(3.7).circle(3.1).extrude(4, both=True)
    ring = ring.cut(W("XZ", origin=(0, 0, 3.8)).polyline([(0, 0), (-5, 6.5), (5, 6.5)]).close().extrude(10, both=True))
    slope, lips = math.radians(55), []
    for s in (-1, 1):
        lip = W().box(3.2, 8, 0.6, centered=(False, True, True)).rotate((0, 0, 0), (0, 1, 0), -math.degrees(slope)).translate((2.0, 0, 6.35))
        lips.append(lip if s > 0 else lip.mirror("YZ"))
    body = joined(foot.union(ring), lips)
    stop = W().box(3, 0.6, 3.5, centered=(True, True, False)).edges("|Y and >Z").fillet(1).translate((0, 3.7, 0))
    legs = [W().box(1.4, 0.6, 5).translate((x, y, -2.2)).edges("|Y and <Z").chamfer(0.4) for x, y in ((-2, -2), (2, 2))]
    return joined(body, [stop] + legs).cut(disc(0.7, 4, -1))


@part(turn=True, offset=1.0)
def vented_housing():
    body = rounded_rect(80, 56, 7, 26).faces("<Z").edges().fillet(3).cut(rounded_rect(77, 53, 5.5, 40).faces("<Z").edges().fillet(1.5).translate((0, 0, 1.5)))
    body = body.union(rounded_rect(90, 66, 10, 1.5).translate((0, 0, 24.5)).cut(rounded_rect(78, 54, 6, 10).translate((0, 0, 20))))
    dimples = [turned((0, -0.01), (5, -0.01), (3.4, 2), (0, 2)).translate((x, y, 0)) for x in (-28, 28) for y in (-17, 17)]
    backs = [turned((0, 1), (6.2, 1), (6.2, 1.5), (4.6, 3.5), (0, 3.5)).translate((x, y, 0)) for x in (-28, 28) for y in (-17, 17)]
    body = less(joined(body, backs), dimples + [disc(1.6, 10, -1, x, y) for x in (-28, 28) for y in (-17, 17)])
    body = less(body, [W("XY", origin=(6 * k - 15, 0, -5)).slot2D(20, 2.6, 90).extrude(12) for k in range(6)])
    body = body.cut(W("YZ", origin=(30, 8, 14)).circle(6).extrude(30)).cut(W("YZ", origin=(30, -10, 14)).rect(12, 8).extrude(30))
    return less(body, [disc(1.8, 10, 20, x, y) for x in (-42, 42) for y in (-20, 20)])
