"""Parts of a mechanism that may be given in place of it: a framework, a linkage, a table of joints.

Which of them something is can be told before what models them is loaded.
"""

from __future__ import annotations

from typing import Any

from nag.algebra.given import is_a


def model_parts(given: Any) -> Any:
    """What parts make: the model of their assemblies, or a mechanism; of a case what it describes.

    Anything else is given back as it is.

    Raises:
        nag.MechanismError: if the parts have no model.
    """
    if is_a(given, "nag.files.cases", "Case"):
        return given.described
    if is_a(given, "nag.mechanism.framework", "Framework"):
        from nag.mechanism.framework_model import framework_model

        return framework_model(given)
    if is_a(given, "nag.mechanism.linkage", "Linkage"):
        from nag.mechanism.linkage import linkage_model

        return linkage_model(given)
    if is_a(given, "nag.mechanism.dh", "DHLoop"):
        from nag.mechanism.dh import assemble_table, dh_model

        return dh_model(given) if given.open else assemble_table(given)
    return given
