"""What stands below fields and attributes in the source, put where `help` finds it."""

from __future__ import annotations

import re
from typing import Any, Dict

_declared = re.compile(r'^ {4}(?: {4}self\.)?(\w+): .*\n +"""((?:.|\n)*?)"""', re.MULTILINE)


def document(module: Dict[str, Any]) -> None:
    """Of all classes of a module, by its names: it calls this at its end."""
    if not module["__file__"].endswith(".py"):  # compiled, without its source: help says less then
        return
    try:
        with open(module["__file__"], encoding="utf-8") as file:
            source = file.read()
    except OSError:  # in an archive
        return
    for part in re.split(r"^class ", source, flags=re.MULTILINE)[1:]:
        kind = module.get(re.split(r"\W", part, maxsplit=1)[0])
        if isinstance(kind, type):  # and not what a text says of one
            _document(kind, {name: " ".join(text.split()) for name, text in _declared.findall(part)})


def _document(kind: Any, texts: Dict[str, str]) -> None:
    fields = getattr(kind, "_fields", ())
    lines = []
    for name, text in texts.items():
        if name in fields:
            getattr(kind, name).__doc__ = text
        elif not name.startswith("_"):
            lines += [name, f"    {text}"]
    if lines and kind.__doc__:
        kind.__doc__ = "\n".join([kind.__doc__.rstrip(), "", "    Attributes", "    ----------", *("    " + line for line in lines), "    "])
