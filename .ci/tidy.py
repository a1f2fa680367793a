"""Runs clang-tidy over every source of a build folder: tidy.py BUILD-FOLDER.

Most of clang-tidy's time goes into the same headers again and again, so sources are first looked at together, as one
translation unit. Files in which that has findings (or does not compile, because two files use a name each for itself)
are looked at in smaller groups, in the end one by one, and only what is found there counts. A clean result is kept in
BUILD-FOLDER/tidy and holds until one of the files, the headers they include, the options or the tool changes.
"""

import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

TOOL = "clang-tidy-14"
# Together, files take little more than one of them.
FILES_PER_UNIT = 45
# What is wrong only because they are together: one file's names hide in another's, factories are declared again.
TOGETHER = ("--checks=-bugprone-suspicious-include,-readability-redundant-declaration", "--extra-arg=-Wno-shadow")


def read_commands(build, root):
    """Triples (source, folders, options): where headers are searched for, and the rest of what does not belong to one object file."""
    for entry in json.loads((build / "compile_commands.json").read_text()):
        source = Path(entry["file"])
        if not source.is_relative_to(root) or source.is_relative_to(build):
            continue
        words = shlex.split(entry["command"])
        while not Path(words[0]).name.startswith(("g++", "c++", "clang++")):
            words.pop(0)
        folders, options = [], []
        words = iter(words[1:])
        for word in words:
            if word in ("-o", "-MF", "-MT", "-MQ", "-c", "-include"):
                next(words)
            elif word == "-isystem":
                folders.append((word, next(words)))
            elif word.startswith("-I"):
                folders.append(("-I", word[2:]))
            elif word not in ("-MD", "-MMD", "-Winvalid-pch"):
                options.append(word)
        yield source, folders, tuple(options)


def make_units(build, root):
    """Pairs (options, sources): sources whose options differ at most in where headers are searched for."""
    groups = {}
    for source, folders, options in read_commands(build, root):
        sources, searched = groups.setdefault(options, ([], {}))
        sources.append(source)
        searched.update(dict.fromkeys(folders))
    for options, (sources, searched) in sorted(groups.items()):
        sources.sort()
        everything = (*options, *(word for folder in sorted(searched) for word in folder))
        for first in range(0, len(sources), FILES_PER_UNIT):
            yield everything, sources[first : first + FILES_PER_UNIT]


class Checker:
    def __init__(self, build, root):
        self.build, self.root = build, root
        self.cache = build / "tidy"
        self.cache.mkdir(exist_ok=True)
        version = subprocess.run([TOOL, "--version"], capture_output=True, text=True, check=True).stdout
        self.base = version + (root / ".clang-tidy").read_text() + Path(__file__).read_text()
        self.digests = {}
        # Our own headers are seen below build/*/include, through links.
        escaped = re.escape(str(root))
        self.header_filter = f"^{escaped}/((core|app|tests)|build/[^/]*/include)/.*\\.(h|cpp)$"

    def digest(self, path):
        if path not in self.digests:
            self.digests[path] = hashlib.sha256(path.read_bytes()).hexdigest()
        return self.digests[path]

    def key(self, options, sources):
        """Changes with everything that clang-tidy's answer could depend on, system headers apart."""
        listing = subprocess.run(
            ["g++", *options, "-MM", *map(str, sources)], capture_output=True, text=True, cwd=self.build
        )
        if listing.returncode:
            return None
        files = {Path(word) for word in shlex.split(listing.stdout.replace("\\\n", " ")) if not word.endswith(":")}
        parts = [f"{path} {self.digest(self.build / path)}" for path in sorted(files)]
        return hashlib.sha256("\n".join([self.base, *options, *parts]).encode()).hexdigest()

    def tidy(self, file, options, *more):
        command = [TOOL, "--quiet", f"--header-filter={self.header_filter}", *more, str(file), "--", *options]
        run = subprocess.run(command, capture_output=True, text=True, cwd=self.root, stdin=subprocess.DEVNULL)
        return run.returncode == 0, run.stdout.strip() or run.stderr.strip()

    def check(self, unit):
        """Findings of the unit as text; empty when it is clean."""
        options, sources = unit
        key = self.key(options, sources)
        mark = self.cache / f"{key}.clean"
        if key and mark.exists():
            return ""
        findings, groups = [], [sources]
        while groups:
            group = groups.pop()
            if len(group) == 1:
                clean, text = self.tidy(group[0], options)
                findings += [] if clean else [text]
                continue
            name = hashlib.sha256("".join(map(str, group)).encode()).hexdigest()
            together = self.cache / f"{name}.cpp"
            together.write_text("".join(f'#include "{source}"\n' for source in group))
            clean, text = self.tidy(together, options, *TOGETHER)
            if clean:
                continue
            # Whoever is named tries again apart from the others.
            errors = [line for line in text.splitlines() if "error:" in line]
            named = [source for source in group if any(line.startswith(f"{source}:") for line in errors)]
            rest = [source for source in group if source not in named]
            groups += [named, rest] if named and rest else [group[::2], group[1::2]]
        if not findings and key:
            mark.touch()
        return "\n".join(findings)


def main():
    build = Path(sys.argv[1]).resolve()
    root = Path(__file__).resolve().parent.parent
    checker = Checker(build, root)
    # The biggest first, so that none is left alone at the end.
    units = sorted(make_units(build, root), key=lambda unit: -len(unit[1]))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        findings = [text for text in pool.map(checker.check, units) if text]
    for text in findings:
        print(text)
    print(f"{sum(len(unit[1]) for unit in units)} files looked at, {len(findings)} groups with findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
