"""Follows each link of the pages in a folder, also to headings: links.py FOLDER."""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """The links of a page, and what links may lead to in it."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.places: set[str] = set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.links.append(value)
            elif name in ("id", "name") and value:
                self.places.add(value)


def target_of(link: str, page: Path, root: Path) -> Path:
    """The file that a link of a page leads to."""
    path = unquote(urlsplit(link).path)
    found = page if not path else (root / path[1:] if path.startswith("/") else page.parent / path)
    return found / "index.html" if found.is_dir() else found


def main() -> None:
    root = Path(sys.argv[1])
    pages = {path.resolve(): Page(path) for path in root.rglob("*.html")}
    dead = []
    followed = 0
    for path, page in pages.items():
        for link in page.links:
            if urlsplit(link).scheme or link.startswith("//") or path.name == "404.html":
                continue
            if "reference/cpp" in path.as_posix():  # doxygen leads to headings of lists that are empty
                continue
            followed += 1
            target = target_of(link, path, root).resolve()
            place = unquote(urlsplit(link).fragment)
            is_there = target.exists() and (
                not place or target not in pages or place in pages[target].places
            )
            if not is_there:
                dead.append(f"{path.relative_to(root.resolve())}: {link}")
    print(f"{len(pages)} pages, {followed} links")
    if dead or not followed:
        sys.exit("links that lead nowhere:\n" + "\n".join(dead))


main()
