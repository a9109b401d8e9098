"""The documents of an installation: they are there, and every link in them leads to something.

  TestDocuments.py PREFIX
"""

import os
import re
import subprocess
import sys
import unittest

PREFIX = sys.argv[1]
DOCUMENTS = os.path.join(PREFIX, "share", "doc", "flipfree")


def anchor_of(heading):
    """As GitHub and most others make it."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class TestDocuments(unittest.TestCase):
    def test_links_lead_somewhere(self):
        for name in ("README.md", "CHANGELOG.md", "LICENSE"):
            self.assertTrue(os.path.exists(os.path.join(DOCUMENTS, name)), name)
        pages = [os.path.join(folder, name) for folder, _, names in os.walk(DOCUMENTS)
                 for name in names if name.endswith(".md")]
        links = 0
        for page in pages:
            text = re.sub("```.*?```", "", text_of(page), flags=re.DOTALL)
            for target in re.findall(r"\]\(([^)\s]+)\)", text):
                if re.match("https?:", target):
                    continue
                links += 1
                path, _, anchor = target.partition("#")
                file = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
                self.assertTrue(os.path.exists(file), f"{page}: {target}")
                if anchor:
                    anchors = [anchor_of(heading) for heading in
                               re.findall("^#+ (.*)$", text_of(file), re.MULTILINE)]
                    self.assertIn(anchor, anchors, f"{page}: {target}")
        self.assertGreater(links, 2)

    @unittest.skipUnless(os.path.exists(os.path.join(PREFIX, "bin", "flipfree")), "no command")
    def test_manual_page_and_completion(self):
        command = [os.path.join(PREFIX, "bin", "flipfree"), "--generate"]
        zsh = os.path.join(PREFIX, "share", "zsh", "site-functions", "_flipfree")
        bash = os.path.join(PREFIX, "share", "bash-completion", "completions", "flipfree")
        page = os.path.join(PREFIX, "share", "man", "man1", "flipfree.1")
        for kind, path in (("man", page), ("bash", bash), ("zsh", zsh)):
            self.assertEqual(subprocess.check_output([*command, kind], text=True), text_of(path))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
