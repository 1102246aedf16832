#!/usr/bin/env python3
"""The docs against the sources. Fails with a line for each difference.

JSON examples parse; the tables of options in docs/formats.md equal the describe() functions; commands and flags that the
docs name exist, and every command is in the guide; keys of job.json and results.json and columns of the CSV tables are
documented.
"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = [page for page in [*sorted(ROOT.glob("*.md")), *sorted(ROOT.glob("docs/**/*.md"))] if page.is_file()]
FORMATS = ROOT / "docs" / "formats.md"
GUIDE = ROOT / "docs" / "guide" / "first-job.md"
STRING = r'"(?:[^"\\]|\\.)*"'
problems = []


def source(path):
    return (ROOT / path).read_text(encoding="utf-8")


def text_of(page):
    return page.read_text(encoding="utf-8")


def name_of(page):
    return str(page.relative_to(ROOT))


def blocks(page):
    """Fenced blocks of a page: line of the fence, word behind it, content."""
    found, opened, word, lines = [], 0, "", []
    for number, line in enumerate(text_of(page).splitlines(), 1):
        fence = re.match(r"\s*```\s*(\w*)\s*$", line)
        if not fence:
            lines.append(line)
        elif opened:
            found.append((opened, word, "\n".join(lines)))
            opened = 0
        else:
            opened, word, lines = number, fence.group(1), []
    if opened:
        problems.append(f"{name_of(page)}:{opened}: a block is not closed")
    return found


# --- JSON examples

def check_json(job_keys):
    count = 0
    for page in PAGES:
        for line, word, content in blocks(page):
            if word != "json":
                continue
            count += 1
            try:
                example = json.loads(content)
            except ValueError as error:
                problems.append(f"{name_of(page)}:{line}: this is not JSON: {error}")
                continue
            if isinstance(example, dict) and example.get("adit") == 1:
                for key in set(example) - job_keys:
                    problems.append(f"{name_of(page)}:{line}: job.json has no key \"{key}\"")
    if count == 0:
        problems.append("the docs hold no JSON example")
    return count


# --- Options

def groups():
    """Group names and their structs, from the one list of groups."""
    job = source("core/job/job.h")
    structs = {}
    for header in ROOT.glob("core/**/*.h"):
        text = header.read_text(encoding="utf-8")
        structs.update((member, struct) for struct, member in re.findall(r"^\s*(\w+Options) (\w+);", text, re.M))
    structs.update((member, struct) for struct, member in re.findall(r"^\s*(\w+Options) (\w+);", job, re.M))
    members = re.findall(r'visit\("(\w+)", options\.([\w.]+)\)', job)
    return {group: structs[member.split(".")[-1]] for group, member in members}


def arguments(text):
    """The arguments of a call, split at commas outside strings, braces and brackets; neighbouring strings joined."""
    parts, depth, part = [], 0, ""
    for token in re.findall(STRING + r"|[\s\S]", text):
        if token in "({[":
            depth += 1
        if token in ")}]":
            depth -= 1
        if token == "," and depth == 0:
            parts.append(part.strip())
            part = ""
        else:
            part += token
    parts.append(part.strip())
    return parts


def joined_string(text):
    return "".join(json.loads(piece) for piece in re.findall(STRING, text))


def default_of(body, member):
    found = re.search(r"\b" + member + r"\s*(?:=\s*([^;]+)|\{([^;]*)\});", body)
    if not found:
        problems.append(f"the options in the sources: no default for {member}")
        return ""
    return (found.group(1) or found.group(2)).strip()


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def described(struct):
    """Options of a struct: name -> (unit, range, default, meaning)."""
    for header in ROOT.glob("core/**/*.h"):
        text = header.read_text(encoding="utf-8")
        function = re.search(r"void describe\(Visitor& v, " + struct + r"& o\) \{(.*?)\n\}", text, re.S)
        if function:
            break
    else:
        problems.append(f"{struct} has no describe()")
        return {}
    body = re.search(r"struct " + struct + r" \{(.*?)\n\};", text, re.S).group(1)
    options = {}
    calls = r"(?:v\.(\w+)|visit_(choice))\(((?:" + STRING + r"|[^\"();]|\([^()]*\))*)\);"
    for kind, enumeration, call in re.findall(calls, function.group(1)):
        parts = arguments(call.removeprefix("v, ") if enumeration else call)
        kind = kind or enumeration
        name, member = joined_string(parts[0]), parts[1].removeprefix("o.")
        default = default_of(body, member)
        if kind in ("number", "count"):
            options[name] = (joined_string(parts[2]), (number(parts[3]), number(parts[4])), number(default), joined_string(parts[5]))
        elif kind == "flag":
            options[name] = ("", ("true", "false"), default, joined_string(parts[2]))
        elif kind == "choice":
            options[name] = ("", tuple(json.loads(w) for w in re.findall(STRING, parts[2])), default.split("::")[-1].strip('"'), joined_string(parts[3]))
        else:
            problems.append(f"{struct}: describe() calls {kind}, which this test does not know")
    if not options or len(options) != function.group(1).count("v.") + function.group(1).count("visit_choice(v,"):
        problems.append(f"{struct}: not every line of describe() was understood")
    return options


def documented(group):
    """The table under the heading of a group."""
    section = re.search(r"^### " + group + r"\n(.*?)(?=^#|\Z)", text_of(FORMATS), re.S | re.M)
    if not section:
        problems.append(f"docs/formats.md: no heading for the options \"{group}\"")
        return {}
    options = {}
    for row in re.findall(r"^\|(.*)\|\s*$", section.group(1), re.M)[2:]:
        cells = [cell.strip() for cell in row.split("|")]
        name = cells[0].strip("`")
        if len(cells) != 5:
            problems.append(f"docs/formats.md: option {group}.{name}: five cells are needed")
            continue
        limits = cells[2].split(" to ") if " to " in cells[2] else cells[2].split(", ")
        if name in options:
            problems.append(f"docs/formats.md: option {group}.{name} stands twice")
        options[name] = (cells[1], tuple(number(limit) for limit in limits), number(cells[3]), cells[4])
    return options


def check_options():
    count = 0
    known = groups()
    if not known:
        problems.append("core/job/job.h: no group of options found")
    for group, struct in known.items():
        in_sources, in_docs = described(struct), documented(group)
        for name in in_sources.keys() - in_docs.keys():
            problems.append(f"docs/formats.md: option {group}.{name} is missing")
        for name in in_docs.keys() - in_sources.keys():
            problems.append(f"docs/formats.md: option {group}.{name} does not exist")
        for name in in_sources.keys() & in_docs.keys():
            count += 1
            for what, a, b in zip(("unit", "range", "default", "meaning"), in_docs[name], in_sources[name]):
                if a != b:
                    problems.append(f"docs/formats.md: option {group}.{name}: {what} is {b!r} in the sources, {a!r} here")
    return count


# --- Commands

def table_of_commands():
    table = re.search(r"std::vector<Command> commands\(\) \{(.*?)\n\}", source("app/command_line/main.cpp"), re.S)
    return set(re.findall(r"\{\"([a-z]+)\", \"", table.group(1))) if table else set()


def declared_flags():
    sources = "".join(file.read_text(encoding="utf-8") for file in sorted(ROOT.glob("app/command_line/*.cpp")))
    flags = set()
    for word in re.findall(r'(?:add_option|add_flag|version_flag)\("([^"]*)"', sources):
        flags.update(part for part in word.split(",") if part.startswith("--"))
    return flags | {"--help"}


def lines_of_code(page):
    """Inline code and the lines of blocks that are not JSON."""
    text = re.sub(r"^\s*```.*?^\s*```\s*$", "", text_of(page), flags=re.S | re.M)
    lines = [span.replace("\n", " ") for span in re.findall(r"`([^`]+)`", text)]
    for _, word, content in blocks(page):
        if word != "json":
            lines += content.splitlines()
    return lines


def check_commands():
    commands, flags, named = table_of_commands(), declared_flags(), set()
    if not commands:
        problems.append("app/command_line/main.cpp: the table of commands was not found")
    for page in PAGES:
        for line in lines_of_code(page):
            for command in re.findall(r"(?:^|[\s/(\"])adit ([a-z][a-z-]*)", line):
                named.add((page, command))
                if command not in commands:
                    problems.append(f"{name_of(page)}: there is no command `adit {command}`")
            if line.startswith("--") or re.search(r"(?:^|[\s/(\"])adit [a-z-]", line):
                for flag in set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", line)) - flags:
                    problems.append(f"{name_of(page)}: no command of adit knows {flag}")
    for command in commands - {command for page, command in named if page == GUIDE}:
        problems.append(f"docs/guide/first-job.md: the command `adit {command}` is not named")
    return len(named)


# --- Keys and columns

def words_in_code(page):
    return set(re.findall(r"[a-z][a-z0-9_]*", " ".join(re.findall(r"`([^`\n]+)`", text_of(page)))))


def check_keys():
    words = words_in_code(FORMATS)
    keys = set()
    for known in re.findall(r"only_keys\(\{([^}]*)\}", source("io/job_json.cpp")):
        keys.update(re.findall(r'"(\w+)"', known))
    results = source("io/results_json.cpp")
    keys.update(re.findall(r'\{"(\w+)",', results))
    keys.update(re.findall(r'\["(\w+)"\]', results))
    for line in re.findall(r'"([a-z0-9_,]+(?:\\n)?)"', source("io/csv_tables.cpp")):
        if line.count(",") > 3:
            keys.update(word for word in line.removesuffix("\\n").split(",") if word)
    for key in sorted(keys - words):
        problems.append(f"docs/formats.md: \"{key}\" is not documented")
    return len(keys)


def root_keys():
    root = max(re.findall(r"only_keys\(\{([^}]*)\}", source("io/job_json.cpp")), key=len)
    return set(re.findall(r'"(\w+)"', root))


counts = {"JSON examples": check_json(root_keys()), "options": check_options(), "commands named": check_commands(),
          "keys and columns": check_keys()}
print(", ".join(f"{count} {what}" for what, count in counts.items()))
print("\n".join(problems))
sys.exit(1 if problems else 0)
