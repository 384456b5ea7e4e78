"""Watches xacro's own functions: calls of macros, properties, parameters, arguments and files of YAML."""

import functools
import sys

from .documents import UNKNOWN, Evaluated, Text

FUNCTIONS = ["eval_text", "eval_extension", "eval_default_arg", "grab_macro", "handle_macro_call", "process_include"]
FUNCTIONS += ["reqd_attrs", "eval_all"]


def watch(watch, xacro):
    if sys.version_info < (3,) or not all(hasattr(xacro, name) for name in FUNCTIONS):
        return

    def patch(owner, name):
        """Replaces a function, which is given to its replacement."""

        def replace(wrapper):
            plain = getattr(owner, name)
            setattr(owner, name, functools.wraps(plain)(lambda *all, **named: wrapper(plain, *all, **named)))

        return replace

    @patch(xacro, "eval_text")
    def eval_text(plain, text, symbols):
        if isinstance(text, str) and "load_yaml" in text:
            watch_yaml(watch)
        if not isinstance(text, Text):
            if not watch.reading:
                watch.last = None
            return plain(text, symbols)
        return watch.evaluate(text, lambda: plain(str(text), symbols))

    @patch(xacro, "eval_extension")
    def eval_extension(plain, text):
        words = text[2:-1].split() or [""]
        if words[0] not in ("find", "dirname", "cwd"):
            places = watch.arguments.get(words[-1]) if words[0] == "arg" else None
            watch.read("symbol", places or [UNKNOWN])
        return plain(text)

    @patch(xacro, "eval_default_arg")
    def eval_default_arg(plain, forwarded, default, *others):
        watch.reading.append([])
        watch.last = None
        try:
            result = plain(forwarded, default, *others)
        finally:
            reads = watch.reading.pop()
        if watch.last is None and reads:
            text = Text("${%s}" % forwarded)
            text.place = getattr(default, "place", None)
            watch.last = Evaluated(text, reads, result)
        return result

    @patch(xacro, "grab_macro")
    def grab_macro(plain, element, macros):
        plain(element, macros)
        try:
            name = str(element.getAttribute("name"))
            made = macros[name[6:] if name.startswith("xacro:") else name]
            for parameter, (forwarded, default) in list(made.defaultmap.items()):
                if default is not None:
                    text = Text(default)
                    text.place = element.urdd_place[:3] + ("params", parameter)
                    made.defaultmap[parameter] = (forwarded, text)
        except Exception:
            pass

    @patch(xacro, "handle_macro_call")
    def handle_macro_call(plain, node, macros, symbols):
        if not node.tagName.startswith("xacro:"):
            return plain(node, macros, symbols)
        place = getattr(node, "urdd_place", None)
        watch.pending.append(len(watch.calls))
        watch.calls.append([place and list(place[:3]), node.tagName[6:], watch.call])
        try:
            return plain(node, macros, symbols)
        except Exception as error:
            watch.blame(error, place)
            raise
        finally:
            watch.pending.pop()

    @patch(xacro, "process_include")
    def process_include(plain, element, *others):
        try:
            return plain(element, *others)
        except Exception as error:
            watch.blame(error, getattr(element, "urdd_place", None))
            raise

    @patch(xacro, "reqd_attrs")
    def reqd_attrs(plain, tag, names):
        watch.tag = tag
        return plain(tag, names)

    @patch(xacro, "eval_all")
    def eval_all(plain, node, *others):
        around = watch.call
        if node.tagName == "xacro:macro" and watch.pending:
            watch.call = watch.pending[-1]
        if not hasattr(node, "urdd_call"):
            node.urdd_call = watch.call
        try:
            return plain(node, *others)
        except Exception as error:
            inner = watch.tag if getattr(watch.tag, "parentNode", None) is node else node
            watch.blame(error, getattr(inner, "urdd_place", None))
            raise
        finally:
            watch.call = around

    @patch(xacro.Table, "_setitem")
    def set_item(plain, table, key, value, *others, **named):
        last, watch.last = watch.last, None
        if isinstance(value, Text):
            places = (frozenset([value.place]), value)
            value = str(value)
        elif last is not None and last.result is value:
            places = (last.places, None)
        else:
            places = (frozenset([UNKNOWN]), None)
        table.__dict__.setdefault("urdd_places", {})[key] = places
        plain(table, key, value, *others, **named)

    @patch(xacro.Table, "_resolve_")
    def resolve(plain, table, key):
        places, text = table.__dict__.get("urdd_places", {}).get(key, (None, None))
        if text is not None and key in table.unevaluated:
            before = watch.last
            value = watch.evaluate(text, lambda: plain(table, key))
            if watch.last is not None:
                places = watch.last.places
            table.__dict__["urdd_places"][key] = (places, None)
            watch.last = before
        else:
            value = plain(table, key)
        if is_container(value):
            watch.read("container", [UNKNOWN])
        elif places is not None and not isinstance(value, xacro.Table):
            watch.read("symbol", places)
        return value

    def is_container(value):
        return id(value) in watch.marks or hasattr(value, "__dict__") and "urdd_marks" in value.__dict__

    def item(container, key, result):
        """Notes that an item of a YAML was read, and that its container was not read as a whole."""
        if not watch.reading:
            return
        reads = watch.reading[-1]
        for number in range(len(reads) - 1, -1, -1):
            if reads[number].kind == "container":
                del reads[number]
                break
        if is_container(result):
            watch.read("container", [UNKNOWN])
        elif isinstance(result, (dict, list)):
            watch.read("symbol", [UNKNOWN])
        else:
            marks = container.__dict__.get("urdd_marks")
            place, value = marks[key] if marks else (UNKNOWN, result)
            watch.read("item", [place if value is result else UNKNOWN])

    def patch_container(owner, is_list):
        @patch(owner, "__getitem__")
        def get(plain, self, key):
            result = plain(self, key)
            try:
                marks = self.__dict__.get("urdd_marks")
                if is_list and isinstance(key, slice) and marks is not None:
                    result.__dict__["urdd_marks"] = marks[key]
                item(self, key, result)
            except Exception:
                watch.read("symbol", [UNKNOWN])
            return result

        def init(self, *others, **named):
            (list if is_list else dict).__init__(self, *others, **named)
            if others and not named:
                _, marks = watch.marks.get(id(others[0]), (None, getattr(others[0], "__dict__", {}).get("urdd_marks")))
                if marks is not None:
                    self.__dict__["urdd_marks"] = marks

        owner.__init__ = init
        if not is_list:
            owner.__getattr__ = owner.__getitem__

    if hasattr(xacro, "YamlDictWrapper") and hasattr(xacro, "YamlListWrapper"):
        patch_container(xacro.YamlDictWrapper, False)
        patch_container(xacro.YamlListWrapper, True)
    namespace = getattr(xacro, "_global_symbols", {}).get("xacro")
    if namespace is not None and "arg" in namespace:
        plain_arg = dict.__getitem__(namespace, "arg")

        def argument(name):
            watch.read("symbol", watch.arguments.get(name, [UNKNOWN]))
            return plain_arg(name)

        dict.__setitem__(namespace, "arg", argument)


def watch_yaml(watch):
    try:
        import yaml

        plain = yaml.safe_load
        if hasattr(plain, "urdd"):
            return
    except Exception:
        return

    class Loader(yaml.SafeLoader):
        def construct_mapping(self, node, deep=False):
            made = yaml.SafeLoader.construct_mapping(self, node, deep)
            # By now what is merged is among its own.
            self.urdd_items[id(node)] = [
                (self.construct_object(key, True), value) for key, value in node.value
            ]
            return made

        def construct_object(self, node, deep=False):
            made = yaml.SafeLoader.construct_object(self, node, deep)
            if isinstance(node, (yaml.MappingNode, yaml.SequenceNode)):
                self.urdd_made.append((node, made))
            return made

    def load(stream):
        def place(node):
            return (file, node.start_mark.line + 1, node.start_mark.column + 1, "", "")

        try:
            file = watch.file(stream.name)
            begin = stream.tell()
        except Exception:
            return plain(stream)
        try:
            loader = Loader(stream)
            loader.urdd_items, loader.urdd_made = {}, []
            made = loader.get_single_data()
            for node, one in loader.urdd_made:
                if isinstance(one, dict) and id(node) in loader.urdd_items:
                    items = loader.urdd_items[id(node)]
                    marks = {key: (place(value), one.get(key)) for key, value in items}
                elif isinstance(one, list):
                    marks = [(place(value), made) for value, made in zip(node.value, one)]
                else:
                    continue
                watch.marks[id(one)] = (one, marks)
            return made
        except Exception as error:
            mark = getattr(error, "problem_mark", None)
            if mark is not None:
                watch.blame(error, (file, mark.line + 1, mark.column + 1, "", ""))
            stream.seek(begin)
            try:
                return plain(stream)
            except Exception as again:
                if mark is not None:
                    watch.error = again
                raise

    load.urdd = True
    yaml.safe_load = load
