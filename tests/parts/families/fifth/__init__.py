"""The fifth series: parts made after the fourth was scored, and run through no segmenter while they were made."""
from . import brackets, castings, closed_forms, components, enclosures, fittings, flow, hand, hardware, rotating, sheet_metal, springs, vessels

__all__ = ["brackets", "castings", "closed_forms", "components", "enclosures", "fittings", "flow", "hand", "hardware", "rotating", "sheet_metal", "springs",
           "vessels"]
