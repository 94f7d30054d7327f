"""The sixth series: parts made after the fifth was scored, and run through no segmenter while they were made."""
from . import bodies_of_revolution, brackets, castings, closed_forms, components, enclosures, fittings, hand, hardware, outlined, rotating, sheet_metal, vessels

__all__ = ["bodies_of_revolution", "brackets", "castings", "closed_forms", "components", "enclosures", "fittings", "hand", "hardware", "outlined", "rotating",
           "sheet_metal", "vessels"]
