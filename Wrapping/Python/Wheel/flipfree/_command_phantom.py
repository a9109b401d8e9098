"""`flipfree phantom`."""

from __future__ import annotations

import os
from typing import Any, get_args

from ._atomic import output_folder
from ._files import write_image
from ._options import WrongUsage
from ._phantom import Organ
from ._phantom import phantom as make_phantom
from ._types import Shape


def phantom(values: dict[str, Any]) -> None:
    """`flipfree phantom`."""
    name = values["name"]
    if name not in get_args(Shape):
        raise WrongUsage(f"There is no phantom '{name}'. Choose {', '.join(get_args(Shape))}")
    for option, unit in (("size", "NX NY NZ"), ("spacing", "X Y Z, in mm")):
        wrong = next((number for number in values.get(option, ()) if not number > 0), None)
        if wrong is not None:
            raise WrongUsage(f"--{option}: {wrong:g} is not positive. Give --{option} {unit}")
    folder = values.get("output", ".")
    keywords = {
        "size": "dimensions",
        "spacing": "spacing",
        "noise": "noise_standard_deviation",
        "random_seed": "random_seed",
        "lesions": "number_of_lesions",
    }
    given = {keywords[key]: values[key] for key in keywords if key in values}
    with output_folder(folder):
        made = make_phantom(name, **given)
        stem = os.path.join(folder, name)
        write_image(made.image, f"{stem}.nii.gz")
        write_image(made.label_map, f"{stem}-truth.nii.gz")
    if "quiet" in values:
        return
    for label in sorted(made.seeds, key=lambda label: (label != Organ.LIVER, label)):
        (x, y, z), radius = made.seeds[label]
        organ = Organ(label).name.lower().replace("_", " ") if name == "abdomen" else "object"
        print(f"{organ} (label {label}): --seed {x:.2f} {y:.2f} {z:.2f} --radius {radius:.2f}")
    if made.ends:
        points = " ".join(f"--point {x:.2f} {y:.2f} {z:.2f}" for x, y, z in made.ends)
        print(f"object, from end to end: {points}")
