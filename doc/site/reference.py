"""Writes the page of the Python package's reference: reference.py PACKAGE PAGE.

It lists what PACKAGE/__init__.py exports, for mkdocstrings to fill in from the docstrings.
"""

import ast
import sys
from pathlib import Path

HEAD = """# Python, name by name

All that `import gearsweep as gs` gives. [Python](../doc/python.md) tells how to work with it, and a
[tutorial](../doc/tutorials/thesis_figure.md) begins at the beginning.
"""


def main(package, page):
    module_of = {}
    exported = []
    for node in ast.parse((Path(package) / "__init__.py").read_text(encoding="utf-8")).body:
        if isinstance(node, ast.ImportFrom):
            module_of.update({alias.asname or alias.name: node.module for alias in node.names})
        elif isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "__all__":
            exported = ast.literal_eval(node.value)
    if not exported:
        sys.exit(f"{package} exports nothing")
    lines = [HEAD]
    for name in exported:
        lines += [f"## gs.{name}", f"::: {module_of[name]}.{name}", ""]
    Path(page).parent.mkdir(parents=True, exist_ok=True)
    Path(page).write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
