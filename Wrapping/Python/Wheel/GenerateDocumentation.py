"""Writes what the filters' headers say of their properties as a module of Python.

  GenerateDocumentation.py OUTPUT HEADER...

For each class a dictionary: the properties that can be set and got, in the header's order, and the
text of the comment above them. In a build with VTK, the wrapped classes say the same.
"""

import os
import pprint
import re
import sys

COMMENT = re.compile(r"/\*\*(.*?)\*/", re.DOTALL)
SETTER = re.compile(r"\bvoid Set(\w+)\(|\bvtkSet\w*Macro\((\w+),")


def properties_in(header):
    """The documented setters of a class and their comments.

    >>> properties_in('''class A {
    ... ///@{
    ... /**
    ...  * How wide,
    ...  * in mm.
    ...  */
    ... void SetWidth(double value);
    ... double GetWidth() const;
    ... ///@}
    ... };''')
    {'Width': 'How wide, in mm.'}
    """
    properties = {}
    comments = list(COMMENT.finditer(header))
    for comment, following in zip(comments, comments[1:] + [None]):
        code = header[comment.end():following.start() if following else len(header)]
        words = " ".join(re.sub(r"^\s*\*", "", comment[1], flags=re.MULTILINE).split())
        for setter in SETTER.finditer(code.split("protected:")[0]):
            name = setter[1] or setter[2]
            if re.search(rf"\bGet{name}\(|vtkGet\w*Macro\({name}\b", code):
                properties.setdefault(name, words)
    return properties


def main(output, *headers):
    classes = {}
    for path in headers:
        with open(path, encoding="utf-8") as file:
            classes[os.path.splitext(os.path.basename(path))[0]] = properties_in(file.read())
    with open(output, "w", encoding="utf-8") as file:
        file.write('"""Generated from the filters\' headers; do not edit."""\n\n')
        file.write(f"PROPERTIES = {pprint.pformat(classes, sort_dicts=False)}\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
