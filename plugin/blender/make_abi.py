# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes glint/abi.py from src/preview/glint_preview.h, so that nobody copies a struct by hand.

    python3 plugin/blender/make_abi.py           # writes it
    python3 plugin/blender/make_abi.py --check   # exit code 1 where it is not what the header says
"""

import os
import re
import sys

HERE = os.path.dirname(os.path.realpath(__file__))
HEADER = os.path.join(HERE, "..", "..", "src", "preview", "glint_preview.h")
OUTPUT = os.path.join(HERE, "glint", "abi.py")

PREFIX = "glint_preview_"
SCALARS = {
    "size_t": "ctypes.c_size_t",
    "int32_t": "ctypes.c_int32",
    "uint32_t": "ctypes.c_uint32",
    "uint8_t": "ctypes.c_uint8",
    "float": "ctypes.c_float",
    "double": "ctypes.c_double",
    "char": "ctypes.c_char",
}

HEAD = '''# SPDX-License-Identifier: GPL-3.0-or-later
# Made by make_abi.py from glint_preview.h. Do not edit.
"""The C interface of libglint_preview: structs with their defaults, constants, and functions of a library that speaks it."""

import ctypes

'''

TAIL = '''

def load(path):
    """The library at a path, its functions declared. Raises OSError for one that does not load or speaks another ABI."""
    library = ctypes.CDLL(path)
    try:
        for name, (result, arguments) in FUNCTIONS.items():
            function = getattr(library, name)
            function.restype, function.argtypes = result, arguments
    except AttributeError as problem:
        raise OSError(f"{path}: {problem}") from problem
    if library.glint_preview_abi() != ABI:
        raise OSError(f"{path}: found ABI {library.glint_preview_abi()}, expected {ABI}")
    for struct in STRUCTS:
        found, expected = library.glint_preview_size_of(struct.NAME.encode()), ctypes.sizeof(struct)
        if found != expected:
            raise OSError(f"{path}: found {found} bytes in {struct.NAME}, expected {expected}")
    return library


def array_of(struct, items):
    """An array of structs for a pointer and a count; None for none."""
    return (struct * len(items))(*items) if items else None


def pointer(values, kind):
    """The address of a contiguous numpy array of that kind ("float", "int32_t", ...); None stays None. The array must
    live as long as the pointer is used."""
    if values is None:
        return None
    kinds = {"float": ("float32", ctypes.c_float), "int32_t": ("int32", ctypes.c_int32),
             "uint32_t": ("uint32", ctypes.c_uint32), "uint8_t": ("uint8", ctypes.c_uint8)}
    name, scalar = kinds[kind]
    if values.dtype != name or not values.flags.c_contiguous:
        raise TypeError(f"found an array of {values.dtype}, expected a contiguous one of {name}")
    return values.ctypes.data_as(ctypes.POINTER(scalar))
'''


def without_comments(text):
    return re.sub(r"/\*.*?\*/", " ", text, flags=re.S)


def python_name(name):
    """glint_preview_scene_options is SceneOptions."""
    return "".join(part.capitalize() for part in name[len(PREFIX):].split("_"))


def python_type(kind, structs):
    """The ctypes name of a C type without its declarator, such as `const float *`."""
    stars = kind.count("*")
    base = kind.replace("const", " ").replace("*", " ").split()[0]
    if base == "void":
        return "None" if stars == 0 else "ctypes.c_void_p"
    if base == "char" and stars == 1:
        return "ctypes.c_char_p"
    if base.startswith(PREFIX) and base not in structs:
        # A handle, or an enumeration.
        return "ctypes.c_void_p" if stars == 1 else "ctypes.POINTER(ctypes.c_void_p)" if stars else "ctypes.c_int"
    name = python_name(base) if base in structs else SCALARS[base]
    for _ in range(stars):
        name = f"ctypes.POINTER({name})"
    return name


def fields_of(body, structs):
    """Name and ctypes name of each member."""
    out = []
    for line in filter(None, (part.strip() for part in body.split(";"))):
        kind, names = re.match(r"((?:const )?\w+)\s+(.*)", line, flags=re.S).groups()
        for declarator in names.split(","):
            stars, name, count = re.match(r"\s*(\**)\s*(\w+)\s*(?:\[(\d+)\])?", declarator).groups()
            ctype = python_type(kind + stars, structs)
            out.append((name, f"{ctype} * {count}" if count else ctype))
    return out


def values_of(text, macros):
    """The values of an _INIT macro as nested lists of Python expressions."""
    text = re.sub(r"GLINT_PREVIEW_\w+_INIT", lambda found: macros[found.group(0)], text)
    constants = re.findall(r"sizeof\(\w+\)|[{},]|[\w.+-]+", text)
    stack = [[]]
    for token in constants:
        if token == "{":
            stack.append([])
        elif token == "}":
            done = stack.pop()
            stack[-1].append(done)
        elif token != ",":
            stack[-1].append(token)
    return stack[0][0]


def expression(value):
    if isinstance(value, list):
        return "(" + ", ".join(expression(v) for v in value) + ",)"
    if value.startswith("GLINT_PREVIEW_"):
        return value[len("GLINT_PREVIEW_"):]
    return re.sub(r"(?<=[0-9.])f$", "", value)


def write_struct(name, fields, initial, structs):
    lines = [f"class {python_name(name)}(ctypes.Structure):", f'    NAME = "{name}"', "    _fields_ = ["]
    lines += [f'        ("{field}", {ctype}),' for field, ctype in fields]
    lines += ["    ]", "", "    def __init__(self, **values):", "        super().__init__()"]
    for (field, ctype), value in zip(fields, initial):
        if field == "size":
            lines.append("        self.size = ctypes.sizeof(self)")
        elif ctype in {python_name(s) for s in structs}:
            lines.append(f"        self.{field} = {ctype}()")
        elif value != "0" and not (isinstance(value, list) and set(value) == {"0"}):
            lines.append(f"        self.{field} = {expression(value)}")
    lines += ["        for name, value in values.items():", "            setattr(self, name, value)", "", ""]
    return lines


def make(header):
    text = without_comments(header)
    joined = text.replace("\\\n", " ")
    macros = dict(re.findall(r"#define (GLINT_PREVIEW_\w+_INIT)\s+(.*)", joined))
    structs = dict(re.findall(r"typedef struct (\w+) \{(.*?)\} \w+;", joined, flags=re.S))
    lines = ["ABI = " + re.search(r"#define GLINT_PREVIEW_ABI (\d+)", joined).group(1)]
    for body in re.findall(r"typedef enum \w+ \{(.*?)\}", joined, flags=re.S):
        number = -1
        for item in filter(None, (part.strip() for part in body.split(","))):
            name, _, value = (part.strip() for part in item.partition("="))
            number = int(value) if value else number + 1
            lines.append(f"{name[len('GLINT_PREVIEW_'):]} = {number}")
    lines += ["", ""]
    for name, body in structs.items():
        macro = "GLINT_PREVIEW_" + name[len(PREFIX):].upper() + "_INIT"
        lines += write_struct(name, fields_of(body, structs), values_of(macros[macro], macros), structs)
    lines.append(f"STRUCTS = ({', '.join(python_name(name) for name in structs)})")
    lines += ["", "# Result and arguments.", "FUNCTIONS = {"]
    for result, name, arguments in re.findall(r"GLINT_PREVIEW_API ([\w ]+?\**)\s*(glint_preview_\w+)\((.*?)\);", joined,
                                              flags=re.S):
        kinds = []
        for argument in arguments.split(","):
            argument = " ".join(argument.split())
            if argument == "void":
                continue
            kind = re.match(r"(.*?)\s*\w+$", argument).group(1)
            kinds.append("ctypes.c_char_p" if kind == "char *" else python_type(kind, structs))
        inner = "".join(f"{kind}, " for kind in kinds)
        lines.append(f'    "{name}": ({python_type(result, structs)}, [{inner.rstrip(", ")}]),')
    lines.append("}")
    return HEAD + "\n".join(lines) + "\n" + TAIL


def main():
    with open(HEADER, encoding="utf-8") as file:
        wanted = make(file.read())
    if "--check" in sys.argv:
        with open(OUTPUT, encoding="utf-8") as file:
            if file.read() != wanted:
                sys.exit("plugin/blender/glint/abi.py is not what glint_preview.h says: run plugin/blender/make_abi.py")
        return
    with open(OUTPUT, "w", encoding="utf-8") as file:
        file.write(wanted)


if __name__ == "__main__":
    main()
