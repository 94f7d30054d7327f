"""The fourth series: parts made after the third was looked at, and run through no segmenter while they were made."""
from . import castings, components, fittings, flow, household, mounts, rotating, sheet_metal, tools

__all__ = ["castings", "components", "fittings", "flow", "household", "mounts", "rotating", "sheet_metal", "tools"]
