"""Tables in Markdown, and documents of which a program writes a part: between `<!-- begin NAME -->` and `<!-- end NAME -->`."""
import os
import platform
import time


def table(head, rows):
    """Lines of a table whose first column is text; numbers stand to the right."""
    lines = ["| " + " | ".join(head) + " |", "| --- |" + " ---: |" * (len(head) - 1)]
    return lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows]


def significant(x, digits=3):
    """Few digits, in the notation that is shorter to read: 1234 and not 1.23e+03."""
    if x == 0:
        return "0"
    text = f"{x:.{digits}g}"
    return f"{float(text):.0f}" if "e+" in text and abs(x) < 1e7 else text


def part(path, name):
    """The table in a part of a document: rows by the text of their first cells, cells by their columns' heads."""
    with open(path, encoding="utf-8") as file:
        text = file.read().split(f"<!-- begin {name} -->\n")[1].split(f"<!-- end {name} -->\n")[0]
    lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("|")]
    head, _, *rows = lines
    return {row[0]: dict(zip(head[1:], row[1:])) for row in rows}


def publish(path, name, lines):
    """Prints the part, and writes it into the document if there is one."""
    print("\n".join(lines), flush=True)
    if not path:
        return
    with open(path, encoding="utf-8") as file:
        text = file.read()
    begin, end = f"<!-- begin {name} -->\n", f"<!-- end {name} -->\n"
    before, rest = text.split(begin)
    text = f"{before}{begin}\n" + "\n".join(lines) + f"\n\n{end}" + rest.split(end)[1]
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def machine():
    """What the figures of a run were measured on."""
    model = platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            model = next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return f"{time.strftime('%-d %B %Y')}, {os.cpu_count()} cores ({model.replace('(R)', '')})"
