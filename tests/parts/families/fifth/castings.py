"""Cast and machined bodies: a pump, an engine's barrel, a caliper."""
from ..register import part
from ..second.outlines import inside, lying, rounded_rect
from ..shapes import W, disc, turned, joined, less, radial


@part(turn=True, offset=1.0)
def gear_pump_body():
    oval = disc(27, 32, 0, -12).union(disc(27, 32, 0, 12)).union(W("XY").rect(24, 54).extrude(32)).faces("<Z").edges().chamfer(1.5)
    body = oval.union(W("XZ", origin=(0, 0, 16)).circle(12).extrude(36, both=True))
    body = body.union(turned((0, -11), (10, -11), (12, -9), (12, 1), (0, 1)).translate((-12, 0, 0)))
    body = less(body, [disc(15.2, 40, 8, x) for x in (-12, 12)])
    body = body.cut(disc(6, 60, -20, -12)).cut(disc(6, 20, 3, 12)).cut(turned((0, -12), (8.5, -12), (8.5, -5), (0, -5)).translate((-12, 0, 0)))
    body = body.cut(W("XZ", origin=(0, 50, 16)).circle(6.5).extrude(100))
    body = less(body, [W("XZ", origin=(0, y, 16)).circle(8).extrude(12) for y in (36.01, -24.01)])
    spots = [(s * (12 + x), y) for s in (-1, 1) for x, y in (radial(21.4, 0), radial(21.4, 1.1), radial(21.4, -1.1))]
    return less(body, [disc(2.4, 20, 16, x, y) for x, y in spots])


@part(turn=True, offset=0.5)
def finned_cylinder():
    body = joined(disc(27, 66), [rounded_rect(72, 72, 16, 1.8).translate((0, 0, 12 + 6.5 * k)) for k in range(8)])
    body = body.union(rounded_rect(64, 64, 10, 7)).union(turned((0, -14), (24, -14), (25, -13), (25, 1), (0, 1))).union(disc(33, 4, 63))
    port = W("YZ", origin=(0, 0, 35)).rect(30, 24).extrude(42).edges("|X").fillet(6)
    body = body.union(port).cut(W("YZ", origin=(0, 0, 35)).slot2D(18, 13).extrude(60))
    body = less(body, [W("YZ", origin=(34, y, 35)).circle(1.4).extrude(20) for y in (-12, 12)])
    body = body.cut(disc(21, 120, -30)).cut(turned((0, 64), (21, 64), (24.01, 67.01), (0, 67.01)))
    return less(body, [disc(3, 120, -30, x, y) for x in (-25, 25) for y in (-25, 25)])


@part(turn=True, offset=1.0)
def brake_caliper():
    profile = [(-32, 0), (-9, 0), (-9, 33), (9, 33), (9, 0), (24, 0), (24, 46), (-32, 46)]
    body = W("XZ").polyline(profile).close().extrude(28, both=True).edges("|Y").edges(inside((-33, -30, 45), (25, 30, 47))).fillet(9)
    body = body.union(lying(turned((0, -1), (17, -1), (17, 10), (14, 13), (0, 13)), "-x").translate((-32, 0, 17)))
    ears = [W("YZ", origin=(-32, y, 10)).circle(9).extrude(11).union(W().box(11, 14, 18).translate((-26.5, y * 31 / 38, 10))) for y in (-38, 38)]
    body = joined(body, ears).union(disc(4.5, 8, 44, -22.5, 20))
    body = body.cut(lying(disc(12.5, 30).union(disc(14, 3, 9)), "-x").translate((-8, 0, 17)))
    body = body.cut(W("XY", origin=(0, 0, 20)).rect(24, 30).extrude(40).edges("|Z").fillet(5))
    body = less(body, [W("YZ", origin=(-50, y, 10)).circle(4.2).extrude(60) for y in (-38, 38)])
    body = less(body, [W("YZ", origin=(-50, y, 27)).circle(2).extrude(100) for y in (-21, 21)])
    return body.cut(disc(1.6, 30, 30, -22.5, 20)).cut(W("YZ", origin=(-60, 0, 17)).circle(4).extrude(30))
