"""The page: a row a model, with Onde's picture, a reference where there is one, and the verdict."""

import html
import shutil

STYLE = """
body { font: 15px/1.45 sans-serif; margin: 2em auto; max-width: 76em; color: #222 }
table { border-collapse: collapse; width: 100% }
td, th { text-align: left; vertical-align: top; padding: .7em; border-top: 1px solid #ddd }
img { width: 20em; background: repeating-conic-gradient(#ddd 0 25%, #fff 0 50%) 0 / 16px 16px }
.pass { color: #17692b } .fails { color: #a3231c } small { color: #666 }
"""


def image(name, alternative):
    return f'<a href="{html.escape(name)}"><img src="{html.escape(name)}" alt="{html.escape(alternative)}"></a>'


def row(result, folder):
    model = result.model
    cells = [f"<b>{html.escape(model.name)}</b><br><small>{html.escape(result.tests)}</small>"]
    ours = image(f"{model.name}.png", "Onde") if result.rendered else "no picture"
    cells.append(ours)
    theirs = ""
    if result.reference:
        source = model.references[result.reference]
        shutil.copyfile(source, folder / f"{model.name}.{result.reference}.webp")
        theirs = image(f"{model.name}.{result.reference}.webp", result.reference)
        theirs += f"<br><small>{result.reference}</small>"
    cells.append(theirs)
    verdict = "pass" if not result.reasons else "fails"
    lines = [f'<b class="{verdict}">{verdict if not result.reasons else "not yet"}</b>']
    lines += [html.escape(words) for words in result.reasons + result.remarks]
    cells.append("<br>".join(lines))
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


def write(results, folder):
    passed = sum(not result.reasons for result in results)
    rows = "\n".join(row(result, folder) for result in results)
    page = f"""<!doctype html><html lang="en"><meta charset="utf-8"><title>Onde: fidelity</title>
<style>{STYLE}</style>
<h1>How models look</h1>
<p>{passed} of {len(results)} pass: they load, show nothing but what their file says, cover what
a reference picture covers, and the signs that test models carry are right. The references had another
light: compare shapes, textures and materials, not brightness.</p>
<table><tr><th>model<th>Onde<th>reference<th>verdict</tr>
{rows}
</table></html>
"""
    (folder / "index.html").write_text(page)
