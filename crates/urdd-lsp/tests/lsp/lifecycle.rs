use lsp_server::ErrorCode;
use serde_json::{Value, json};
use urdd_lsp::Ended;

use crate::client::{ARM, Client, able};

#[test]
fn shutdown_and_exit_are_orderly_others_are_not() {
    let mut client = Client::new();
    assert_eq!(client.request("shutdown", Value::Null), Value::Null);
    let late = client.ask("textDocument/hover", json!({}));
    let refused = client.answer(&late).response_result.expect_err("an error");
    assert_eq!(refused.code, ErrorCode::InvalidRequest as i32);
    client.notify("exit", Value::Null);
    assert_eq!(client.server.join().unwrap(), Ended::Orderly);

    let client = Client::new();
    client.notify("exit", Value::Null);
    assert_eq!(client.server.join().unwrap(), Ended::Exit);
    let client = Client::connected();
    client.notify("exit", Value::Null);
    assert_eq!(client.server.join().unwrap(), Ended::Exit);
    assert_eq!(Client::new().close(), Ended::Closed);
    assert_eq!(Client::connected().close(), Ended::Closed);
}

#[test]
fn the_first_request_is_initialize() {
    let mut client = Client::connected();
    for (method, code) in [
        ("textDocument/hover", ErrorCode::ServerNotInitialized),
        ("initialize", ErrorCode::InvalidParams),
    ] {
        let id = client.ask(method, json!({"capabilities": 7}));
        let refused = client.answer(&id).response_result.expect_err("an error");
        assert_eq!(refused.code, code as i32);
    }
    let answer = client.request("initialize", json!({"capabilities": {}}));
    assert_eq!(answer["capabilities"]["positionEncoding"], "utf-16");
    assert_eq!(answer["serverInfo"]["name"], "urdd");
}

#[test]
fn what_an_editor_says_in_a_form_of_its_own_is_not_read() {
    let odd = json!({
        "processId": "me",
        "workspaceFolders": {"uri": 3},
        "capabilities": {"general": {"positionEncodings": [3, "utf-32"]}, "textDocument": 5, "workspace": []},
    });
    let answer = Client::connected().request("initialize", odd);
    assert_eq!(answer["capabilities"]["positionEncoding"], "utf-32");
    assert_eq!(answer["capabilities"]["hoverProvider"], true);
}

#[test]
fn unknown_and_malformed_messages_are_refused_and_nothing_ends() {
    let mut client = Client::new();
    for (method, code) in [
        ("textDocument/rename", ErrorCode::MethodNotFound),
        ("textDocument/hover", ErrorCode::InvalidParams),
    ] {
        let id = client.ask(method, json!([1]));
        let refused = client.answer(&id).response_result.expect_err("an error");
        assert_eq!(refused.code, code as i32, "{method}");
    }
    client.notify("textDocument/didOpen", json!({"x": 1}));
    client.notify("$/setTrace", json!({"value": "off"}));
    client.notify("$/cancelRequest", json!({"id": 99}));
    client.notify("$/cancelRequest", json!({}));
    client.change("untitled:never-opened", 2, "x");
    let params = json!({"textDocument": {"uri": "untitled:never-opened"}, "position": {"line": 0, "character": 0}});
    assert_eq!(client.request("textDocument/hover", params), Value::Null);
}

#[test]
fn each_request_has_one_answer_also_if_it_is_cancelled() {
    let mut client = Client::new();
    client.open("untitled:a", ARM);
    let params = json!({"textDocument": {"uri": "untitled:a"}});
    let asked: Vec<_> = (0..50)
        .map(|_| {
            let id = client.ask("textDocument/documentSymbol", params.clone());
            let number: i32 = id.to_string().parse().unwrap();
            client.notify("$/cancelRequest", json!({"id": number}));
            id
        })
        .collect();
    let last = client.ask("textDocument/documentSymbol", params);
    let mut open: std::collections::HashSet<_> = asked.into_iter().collect();
    while !open.is_empty() {
        let Ok(message) = client.connection.receiver.recv() else { panic!("ended") };
        if let lsp_server::Message::Response(response) = message
            && response.id != last
        {
            assert!(open.remove(&response.id), "{response:?}");
            if let Err(error) = response.response_result {
                assert_eq!(error.code, ErrorCode::RequestCanceled as i32);
            }
        }
    }
}

#[test]
fn settings_are_asked_for_where_the_editor_answers() {
    let mut capabilities = able();
    capabilities["workspace"]["configuration"] = json!(true);
    let mut client = Client::with(json!({}), capabilities);
    client.open("untitled:a", ARM);
    client.until(1, |_| true);
    let asked = client.asked.first().expect("a request");
    assert_eq!(asked.method, "workspace/configuration");
    assert_eq!(asked.params, json!({"items": [{"section": "urdd"}]}));
    let response = lsp_server::Response::new_ok(asked.id.clone(), json!([{"debounce": 0}]));
    client.connection.sender.send(response.into()).unwrap();
    client.change("untitled:a", 2, ARM);
    client.until(2, |_| true);
}

#[cfg(target_os = "linux")]
#[test]
fn it_ends_with_the_editor_s_process() {
    let mut child = std::process::Command::new("sleep").arg("600").spawn().unwrap();
    let mut client = Client::connected();
    client.request("initialize", json!({"processId": child.id(), "capabilities": {}}));
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(client.server.join().unwrap(), Ended::ParentGone);
}
