"""Holds JUnit XML, as `urdd validate --format junit` writes it, to what its readers expect.

    python3 .ci/check_junit.py junit-10.xsd REPORT.xml...

junit-10.xsd is the schema of Jenkins' xUnit plugin; pytest's source package carries it, for the same
use. junitparser, a reader by others, must count what the totals say. Needs lxml and junitparser.
"""

import sys

import junitparser
from lxml import etree


def check(schema, path):
    document = etree.parse(path)
    schema.assertValid(document)
    suites = junitparser.JUnitXml.fromfile(path)
    counted = {"tests": 0, "failures": 0, "errors": 0}
    for suite in suites:
        outcomes = [type(result).__name__ for case in suite for result in case.result]
        found = (
            len(list(suite)),
            outcomes.count("Failure"),
            outcomes.count("Error"),
            outcomes.count("Skipped"),
        )
        said = (suite.tests, suite.failures, suite.errors, suite.skipped)
        assert found == said, f"{path}: suite {suite.name}: {said} are said, {found} are there"
        for name, count in zip(counted, found, strict=False):
            counted[name] += count
    said = {name: int(document.getroot().get(name)) for name in counted}
    assert counted == said, f"{path}: {said} are said, {counted} are there"
    print(f"{path}: {counted}")


def main():
    schema = etree.XMLSchema(etree.parse(sys.argv[1]))
    assert sys.argv[2:], "name a report"
    for path in sys.argv[2:]:
        check(schema, path)


main()
