"""results.csv of a study, as the pages of documents read it, and the tables that they write."""
import csv


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def rows_of(folder):
    """Rows by column, units cut off the head; what is no number is text. Empty where the study has not run."""
    path = folder / "results.csv"
    if not path.exists():
        return []
    with open(path, newline="") as text:
        return [{k.split(" [")[0]: number(v) for k, v in row.items()} for row in csv.DictReader(text)]


def table(head, rows):
    text = "| " + " | ".join(head) + " |\n|" + "---|" * len(head) + "\n"
    return text + "".join("| " + " | ".join(str(c) for c in row) + " |\n" for row in rows)
