"""What xacro does, as far as these tests go: includes, and macros with the parameter `prefix`."""

import sys
from os import path
from xml.dom import minidom


def main():
    document = minidom.parse(open(sys.argv[1]))
    expand(document.documentElement, path.dirname(sys.argv[1]), {})
    print(document.toprettyxml())


def expand(element, folder, macros):
    for child in list(element.childNodes):
        if child.nodeType != child.ELEMENT_NODE:
            element.removeChild(child)
            continue
        name = child.tagName
        if name == "xacro:include":
            file = path.join(folder, child.getAttribute("filename"))
            expand(minidom.parse(open(file)).documentElement, folder, macros)
        elif name == "xacro:macro":
            macros["xacro:" + child.getAttribute("name")] = child
        elif name in macros:
            made = macros[name].cloneNode(True)
            for one in made.getElementsByTagName("*"):
                for key in one.attributes.keys():
                    value = one.getAttribute(key)
                    one.setAttribute(key, value.replace("${prefix}", child.getAttribute("prefix")))
            expand(made, folder, macros)
            for one in list(made.childNodes):
                element.insertBefore(one, child)
        else:
            expand(child, folder, macros)
            continue
        element.removeChild(child)
