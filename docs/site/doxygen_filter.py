# SPDX-License-Identifier: MIT
"""Shows a public header to Doxygen as its readers take it. Doxygen calls it with the header's path.

- A comment above overloads, constants or members without blank lines between them is that of each.
- A comment beside several members of one type is that of each.
- Defaulted comparisons, copies and moves are left out: their signature says all.
- Plain comments of a C header are documentation, those between its parts excepted.
"""

import re
import sys

MEMBERS = re.compile(r"^( *)([\w:<>, ]*[\w>]) ([\w\[\]]+(?: = [^,;]+)?(?:, [\w\[\]]+(?: = [^,;]+)?)+);(.*)$")
OBVIOUS = re.compile(r"^ *(~?(\w+)\((const )?\2&&?\)( noexcept)?|\w+& operator=\((const )?\w+&&?\)"
                     r"( noexcept)?|bool operator==\(.*\) const)( = (default|delete))?;")


def documented_c(text: str) -> str:
    """A C header with /// in place of its plain comments. The first is about the file; that of a
    structure speaks of its members, too."""
    text = re.sub(r"^/\* (?:SPDX|----).*\n", "", text, flags=re.M)
    text = re.sub(r"^#define GEOTHERM_API.*\n|GEOTHERM_API ", "", text, flags=re.M)
    text = re.sub(r"^/\* (.*?) ?\*/",
                  lambda found: "/// " + re.sub(r"\n \* ?", "\n/// ", found[1]), text,
                  flags=re.M | re.S)
    text = re.sub(r"(?<=\S) +/\* (.*?) ?\*/",
                  lambda found: " ///< " + re.sub(r"\s+", " ", found[1]), text, flags=re.S)
    text = re.sub(r"^(  [\w *]+[\w\]\[]+(?:, [\w\[\]]+)*;)$", r"\1 ///< See above.", text, flags=re.M)
    text = re.sub(r"(?<=\.\n)/// (?=[A-Z]\w+: )", "///\n/// ", text)  # a paragraph
    text = re.sub(r"^///   (?=\S)", "///     ", text, flags=re.M)  # an example
    return text.replace("/// ", "/// \\file\n/// ", 1)


def belongs(above: str, line: str) -> bool:
    """Whether the comment above a declaration is that of the one below, too."""
    name = re.search(r"(\w+)\(", line)
    if "constexpr" in line or (name and line.startswith("  ")):
        return True
    return name is not None and f" {name[1]}(" in above


def each_documented(lines: list[str], plain_c: bool) -> list[str]:
    """With the comment of a group before each declaration of it."""
    found: list[str] = []
    comment: list[str] = []  # of the group, while it lasts
    inside = False  # a declaration that goes on
    above = ""  # where the declaration before began
    end = ""  # of the body of a function, while it lasts
    for line in lines:
        text = line.strip()
        if end:
            end = "" if line == end else end
        elif not text or text.startswith(("#", "}", "public:", "private:", "protected:")):
            comment, inside = [], False
        elif text.startswith("///") and not text.startswith("///<"):
            if inside or (found and not found[-1].strip().startswith("///")):
                comment = []
            comment.append(line)
            inside = False
        elif not text.startswith(("//", "template")):
            first = not found or found[-1].strip().startswith(("///", "template"))
            bare = not inside and not first and "///<" not in line
            if bare and (plain_c or belongs(above, line)):
                found.extend(comment)
            if not inside:
                above = line
            inside = not re.search(r"[;}](\s*//.*)?$", text)
            if text.endswith("{") and "(" in above:
                end = line[:len(line) - len(line.lstrip())] + "}"
                inside = False
            elif text.endswith("{"):
                comment = []  # of a type, whose members have comments of their own
        if OBVIOUS.match(line):
            continue
        members = MEMBERS.match(line)
        if members and "(" not in members[2] and members[2] not in ("return", "using"):
            space, kind, names, rest = members.groups()
            for number, name in enumerate(re.split(r", (?=[\w\[\]]+(?: =|,|$))", names)):
                if number and not rest.strip():
                    found.extend(comment)
                found.append(f"{space}{kind} {name};{rest}")
        else:
            found.append(line)
    return found


def main() -> None:
    path = sys.argv[1]
    with open(path, encoding="utf-8") as file:
        text = file.read()
    plain_c = text.startswith("/*")
    if plain_c:
        text = documented_c(text)
    text = re.sub(r"(?<=[ (/])(\w+\.h)(?=[^\w\">])", r"%\1", text)  # a file's name is no link
    print("\n".join(each_documented(text.split("\n"), plain_c)))


main()
