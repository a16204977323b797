"""Makes the tutorials notebooks, runs them, and writes them as pages: notebooks.py OUT TUTORIAL.py...

A tutorial is a program in cells: `# %%` begins one of Python, `# %% [markdown]` one of text, and a line
`# !COMMAND` is a command of the terminal. OUT gets NAME.ipynb as it ran and NAME.md with its pictures. A
cell that fails is an error. Needs Debian's packages python3-nbconvert and python3-ipykernel.
"""

import os
import re
import sys
import tempfile
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbconvert import MarkdownExporter

SECONDS_OF_CELL = 600


def cells_of(text):
    """The cells of a program."""
    for part in re.split(r"^# %%", text, flags=re.MULTILINE)[1:]:
        head, _, body = part.partition("\n")
        if "[markdown]" in head:
            yield nbformat.v4.new_markdown_cell(re.sub(r"^# ?", "", body.strip(), flags=re.MULTILINE))
        else:
            yield nbformat.v4.new_code_cell(re.sub(r"^# !", "!", body.strip(), flags=re.MULTILINE))


def write(tutorial, out):
    """The notebook and the page of one tutorial."""
    notebook = nbformat.v4.new_notebook(cells=list(cells_of(tutorial.read_text(encoding="utf-8"))))
    notebook.metadata["kernelspec"] = {"name": "python3", "language": "python", "display_name": "Python 3"}
    with tempfile.TemporaryDirectory(prefix="gearsweep-tutorial-") as folder:
        NotebookClient(notebook, timeout=SECONDS_OF_CELL, kernel_name="python3",
                       resources={"metadata": {"path": folder}}).execute()
    nbformat.write(notebook, out / f"{tutorial.stem}.ipynb")
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            output.get("data", {}).pop("text/html", None)  # a page has its own style for text
    pictures = f"{tutorial.stem}-pictures"
    page, more = MarkdownExporter().from_notebook_node(notebook, {"output_files_dir": pictures})
    (out / pictures).mkdir(exist_ok=True)
    for name, content in more["outputs"].items():
        (out / name).write_bytes(content)
    page += f"\n[This page as a notebook]({tutorial.stem}.ipynb)\n"
    (out / f"{tutorial.stem}.md").write_text(page, encoding="utf-8")


def main(out, *tutorials):
    os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"
    Path(out).mkdir(parents=True, exist_ok=True)
    for tutorial in tutorials:
        print(tutorial)
        write(Path(tutorial), Path(out))


if __name__ == "__main__":
    main(*sys.argv[1:])
