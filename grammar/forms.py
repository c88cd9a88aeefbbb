"""Logical forms: what an utterance means, as predicate-argument terms in the notation of VoxML programs.

The types live with the lexicon, whose program bodies share the notation; the notation itself is in ``docs/forms.md``.
"""

from __future__ import annotations

from voxml.terms import Form, FormError, Name, Quantity, Term, Unit, parse_form

__all__ = ["Form", "FormError", "Name", "Quantity", "Term", "Unit", "parse_form"]
