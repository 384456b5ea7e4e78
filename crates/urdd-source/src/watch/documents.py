"""Notes where the elements of xacro's output are written, by which calls of macros they came there, which one literal a value
is from, and where xacro was when it failed.

What goes wrong here leaves xacro as it is: its functions are called with what they are called with, and their results and
exceptions are passed on.
"""

import ast
import json
import os
import re
import sys

# A value that is not from literals of files, or from too many to say which.
UNKNOWN = None
EXPRESSION = re.compile(r"\$\{([^}]*)\}|\$\([^)]*\)")
# What chooses between literals, or has some of its own.
CHOOSES = (ast.IfExp, ast.Compare, ast.BoolOp, ast.Lambda, ast.ListComp, ast.GeneratorExp)


class Text(str):
    """An attribute's value that knows its place: file, line and column of the element, the attribute, and the parameter of
    which it is the default."""

    place = None
    # The `<xacro:arg>` whose default it is.
    argument = None


class Read(object):
    """Something that was read while a text was evaluated: a symbol, an item of a YAML, or a container as a whole."""

    def __init__(self, kind, places):
        self.kind = kind
        self.places = places


class Evaluated(object):
    """What came of a text, and the places that it is from."""

    def __init__(self, text, reads, result):
        self.result = result
        expressions = [found.group(1) for found in EXPRESSION.finditer(text)]
        trees = [tree for tree in map(parsed, expressions) if tree]
        chain = len(expressions) == 1 and len(trees) == 1 and is_chain(trees[0])
        outside = of_chain(reads) if chain else frozenset().union(*[one.places for one in reads])
        own = any(isinstance(node, CHOOSES) for tree in trees for node in ast.walk(tree))
        # A list of numbers has some beside, a name a part of its own, and a new container its items.
        own = own or re.search(r"\w", EXPRESSION.sub("", text))
        is_container = isinstance(result, (dict, list, tuple))
        own = own or not chain and is_container
        # The places in a file of YAML are not known to all versions of xacro.
        outside |= {UNKNOWN} if is_container and "load_yaml" in text else set()
        self.places = outside | {text.place} if own or not outside else outside


def parsed(expression):
    try:
        return ast.parse(expression.strip(), mode="eval").body
    # One that is none, as of `$(arg NAME)`.
    except Exception:
        return None


def is_chain(tree):
    """Whether it is `a[0]['b'].c`, with nothing but names and constants in brackets: such a value is from where the chain
    ends."""
    while isinstance(tree, (ast.Subscript, ast.Attribute)):
        index = ast.walk(tree.slice) if isinstance(tree, ast.Subscript) else ()
        if any(isinstance(node, (ast.Subscript, ast.Attribute, ast.Call)) for node in index):
            return False
        tree = tree.value
    return isinstance(tree, ast.Name)


def of_chain(reads):
    if not reads:
        return frozenset()
    return reads[-1].places if reads[-1].kind == "item" else reads[0].places


class Watch(object):
    """What is noted of a run."""

    def __init__(self):
        self.files, self.elements, self.calls, self.values = {}, [], [], []
        # What is read in each of the texts that are being evaluated.
        self.reading = []
        # What was evaluated last, until somebody takes it.
        self.last = None
        # The calls of macros that are being expanded, and whose bodies are: the number of the innermost.
        self.pending, self.call = [], None
        self.arguments = {}
        # Where the last exception comes from.
        self.error, self.fault, self.tag = None, None, None
        # By the number of a container that YAML made: itself, and the places and values of its items.
        self.marks = {}

    def file(self, name):
        return self.files.setdefault(os.path.realpath(name), len(self.files))

    def blame(self, error, place):
        """Notes the innermost place of an exception, which others may wrap on their way out."""
        inner, seen = error, 0
        while inner is not None and seen < 100:
            if inner is self.error:
                return
            inner, seen = getattr(inner, "exc", None) or inner.__context__, seen + 1
        if place is not None:
            place = list(place)
            named = re.match(r'Invalid parameter "([^"]*)"', str(error))
            if named and len(place) > 3 and not place[3]:
                # The attribute of the call.
                place[3] = named.group(1)
            self.error, self.fault = error, [place, self.call]

    def read(self, kind, places):
        if self.reading:
            self.reading[-1].append(Read(kind, frozenset(places)))

    def evaluate(self, text, work):
        """Calls `work`, which evaluates a text with a place."""
        self.reading.append([])
        try:
            result = work()
        except Exception as error:
            self.blame(error, text.place)
            raise
        finally:
            reads = self.reading.pop()
        try:
            self.last = Evaluated(text, reads, result)
            if text.argument is not None:
                self.arguments[text.argument] = self.last.places
        except Exception:
            self.last = None
        return result

    def end(self, notes):
        noted = {"files": sorted(self.files, key=self.files.get), "elements": self.elements}
        noted.update({"calls": self.calls, "values": self.values})
        if not self.elements and self.fault:
            noted["fault"] = self.fault
        if self.elements or self.fault:
            with open(notes, "w") as file:
                json.dump(noted, file)

    def write(self, element):
        place = getattr(element, "urdd_place", None)
        number = len(self.elements)
        self.elements.append(place and list(place[:3]) + [getattr(element, "urdd_call", None)])
        try:
            values = getattr(element, "urdd_values", {})
            named = [key for key in element.attributes.keys() if not key.startswith("xmlns")]
            of_element = [values.get(key, frozenset([place])) for key in named if key != "name"]
            found = [(key, values[key]) for key in named if key in values]
            found.append(("", frozenset().union(*of_element)))
            for key, places in found:
                if len(places) == 1 and UNKNOWN not in places:
                    (one,) = places
                    if one[:3] != place[:3]:
                        self.values.append([number, key, list(one)])
        except Exception:
            pass


def watch(watch):
    from xml.dom import expatbuilder, minidom

    parse, start = expatbuilder.ExpatBuilder.parseFile, expatbuilder.Namespaces.start_element_handler
    clone, write, set_attribute = minidom._clone_node, minidom.Element.writexml, minidom.Element.setAttribute

    def parse_file(self, file):
        name = getattr(file, "name", None)
        if isinstance(name, str):
            self.urdd_file = watch.file(name)
        try:
            return parse(self, file)
        except Exception as error:
            if hasattr(error, "lineno") and hasattr(self, "urdd_file"):
                watch.blame(error, (self.urdd_file, error.lineno, error.offset + 1, "", ""))
            raise

    def start_element(self, name, attributes):
        start(self, name, attributes)
        if hasattr(self, "urdd_file"):
            parser, node = self.getParser(), self.curNode
            # Columns are from 0.
            place = (self.urdd_file, parser.CurrentLineNumber, parser.CurrentColumnNumber + 1)
            node.urdd_place = place + ("", "")
            for attribute in node.attributes.values() if attributes and sys.version_info >= (3,) else ():
                text = Text(attribute.value)
                text.place = place + (attribute.name, "")
                if node.tagName == "xacro:arg" and attribute.name == "default":
                    text.argument = node.getAttribute("name")
                attribute.value = text

    def clone_node(node, *others):
        made = clone(node, *others)
        for key in ("urdd_place", "urdd_call", "urdd_values"):
            if hasattr(node, key):
                setattr(made, key, getattr(node, key))
        return made

    def set_value(self, name, value, *others):
        set_attribute(self, name, value, *others)
        last, watch.last = watch.last, None
        if last is not None and value == str(last.result):
            self.urdd_values = dict(getattr(self, "urdd_values", {}))
            self.urdd_values[str(name)] = last.places

    def write_element(self, *others, **named):
        watch.write(self)
        write(self, *others, **named)

    expatbuilder.ExpatBuilder.parseFile = parse_file
    expatbuilder.Namespaces.start_element_handler = start_element
    minidom._clone_node = clone_node
    minidom.Element.setAttribute = set_value
    minidom.Element.writexml = write_element
