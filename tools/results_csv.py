"""results.csv of a study, as the pages of documents read it."""
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
