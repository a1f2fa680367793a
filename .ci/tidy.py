"""Runs clang-tidy over every source of a build folder: tidy.py BUILD-FOLDER.

Most of clang-tidy's time goes into the same headers again and again, so the sources of a target are first looked at
together, as one translation unit. Files in which that has findings (or does not compile, because two files use a name
each for itself) are looked at one by one, and only what is found there counts. A clean result is kept in
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
FILES_PER_UNIT = 25
# What is wrong only because they are together: one file's names hide in another's, factories are declared again.
TOGETHER = ("--checks=-bugprone-suspicious-include,-readability-redundant-declaration", "--extra-arg=-Wno-shadow")


def read_commands(build, root):
    """Triples (source, target, options): what belongs to one object file, and precompiled headers, are left out of the options."""
    for entry in json.loads((build / "compile_commands.json").read_text()):
        source = Path(entry["file"])
        if not source.is_relative_to(root) or source.is_relative_to(build):
            continue
        words = shlex.split(entry["command"])
        while not Path(words[0]).name.startswith(("g++", "c++", "clang++")):
            words.pop(0)
        target = re.search(r"CMakeFiles/([^/]+)\.dir/", words[words.index("-o") + 1]).group(1)
        options, skip = [], False
        for word in words[1:]:
            if skip:
                skip = False
            elif word in ("-o", "-MF", "-MT", "-MQ", "-c", "-include"):
                skip = True
            elif word not in ("-MD", "-MMD", "-Winvalid-pch"):
                options.append(word)
        yield source, target, tuple(options)


def make_units(build, root):
    """Groups of sources with the same options."""
    groups = {}
    for source, target, options in read_commands(build, root):
        groups.setdefault((target, options), []).append(source)
    for (target, options), sources in sorted(groups.items()):
        sources.sort()
        for first in range(0, len(sources), FILES_PER_UNIT):
            yield target, first, options, sources[first : first + FILES_PER_UNIT]


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
        target, first, options, sources = unit
        key = self.key(options, sources)
        mark = self.cache / f"{key}.clean"
        if key and mark.exists():
            return ""
        alone, rest = [], sources
        while len(rest) > 1:
            together = self.cache / f"{target}_{first}.cpp"
            together.write_text("".join(f'#include "{source}"\n' for source in rest))
            clean, text = self.tidy(together, options, *TOGETHER)
            if clean:
                break
            # Whoever is named is looked at by itself; the others try again without.
            errors = [line for line in text.splitlines() if "error:" in line]
            named = [source for source in rest if any(line.startswith(f"{source}:") for line in errors)] or rest
            alone += named
            rest = [source for source in rest if source not in named]
        if len(rest) == 1:
            alone += rest
        results = [self.tidy(source, options) for source in alone]
        findings = [text for good, text in results if not good]
        if not findings and key:
            mark.touch()
        return "\n".join(findings)


def main():
    build = Path(sys.argv[1]).resolve()
    root = Path(__file__).resolve().parent.parent
    checker = Checker(build, root)
    # The biggest first, so that none is left alone at the end.
    units = sorted(make_units(build, root), key=lambda unit: -len(unit[3]))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        findings = [text for text in pool.map(checker.check, units) if text]
    for text in findings:
        print(text)
    print(f"{sum(len(unit[3]) for unit in units)} files looked at, {len(findings)} groups with findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
